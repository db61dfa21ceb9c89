// Measurements of a box, and their file.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/numerics/ranks.hpp"
#include "multiscale/calibrate/plan.hpp"

namespace polybed::multiscale {

/// A mean and its standard error: the greatest error from 20, 10 and 5 blocks, so that slow variations count.
struct Estimate {
  double mean = 0, error = 0;
};

/// Mean and standard error from blocks of equal length; their number is a multiple of 4.
[[nodiscard]] Estimate estimate_of(const std::vector<double>& blocks);

/// Whether blocks twice as long give more than 1.3 times this error: the blocks are then not independent.
[[nodiscard]] bool error_grows(const std::vector<double>& blocks);

/// Means over a box, SI. Ratios are to the closed forms at the measured temperature (dry), or to the viscous form.
struct BoxResult {
  BoxPoint point;
  std::string hash;
  Estimate theta, pressure, viscosity, dissipation, temperature_ratio;  ///< overall, m2/s2, Pa, Pa s, W/m3; T_2/T_1
  Estimate exchange, exchange_ratio;  ///< beta_12 in a pushed box, kg/(m3 s), and over species_exchange_kinetic
  double slip = 0;                    ///< |U_1 - U_2|/sqrt(theta) there
  Estimate pressure_ratio, viscosity_ratio, dissipation_ratio;
  double first_normal = 0, second_normal = 0;  ///< N_1/p, N_2/p
  double contact_share = 0;                    ///< share of contacts in the pressure
  double contacts = 0;                         ///< touching pairs per particle
  double sink = 0;                             ///< W/m3, from drag on fluctuations
  double balance = 0;                          ///< -sigma_yx gamma over Gamma + sink + change of the stored energy
  double drift = 0;                            ///< momentum of the fluctuations over the sum of its parts
  double shear_rate = 0, diameter = 0, density = 0, strain = 0, drag_rate = 0;  ///< drag_rate: 1/(gamma tau_d)
  double softness = 0, max_overlap = 0;  ///< t_c over the time between collisions; overlap over the diameter
  double cpu_seconds = 0, particle_steps = 0;
  Estimate bed_pressure, bed_balance;  ///< in a fluidised bed: from slabs and from the balance of forces, over the unit
  double bed_phi = 0;                  ///< solids fraction of these
  double velocity = 0;                 ///< superficial, in a fluidised bed, m/s
};

/// Writes a finished box as JSON, for the fit in Python.
void write_box(const std::filesystem::path& path, const BoxResult& result);

/// Runs a sheared box of spheres on one rank, or a fluidised one (bed_run.cpp). \param ranks  that share the latter
[[nodiscard]] BoxResult run_box(const core::Scene& scene, const BoxPoint& point,
                                std::shared_ptr<const core::Ranks> ranks = nullptr);
[[nodiscard]] BoxResult run_bed_box(const core::Scene& scene, const BoxPoint& point,
                                    std::shared_ptr<const core::Ranks> ranks);

}  // namespace polybed::multiscale
