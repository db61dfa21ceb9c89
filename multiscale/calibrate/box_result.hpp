// What a box has measured, and its file.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/numerics/ranks.hpp"
#include "multiscale/calibrate/plan.hpp"

namespace polybed::multiscale {

/// A mean and its standard error: the greatest of those from 20, 10 and 5 blocks, so that slow blocks count.
struct Estimate {
  double mean = 0, error = 0;
};

/// Mean and standard error of blocks of equal length, their number a multiple of 4.
[[nodiscard]] Estimate estimate_of(const std::vector<double>& blocks);

/// Whether the error from blocks twice as long is more than 1.3 times that of these: they are not independent.
[[nodiscard]] bool error_grows(const std::vector<double>& blocks);

/// Means over a box, SI. Ratios are to the closed forms at the measured temperature (dry), or to the viscous form.
struct BoxResult {
  BoxPoint point;
  std::string hash;
  Estimate theta, pressure, viscosity, dissipation, temperature_ratio;  ///< of all, m2/s2, Pa, Pa s, W/m3; T_2/T_1
  Estimate exchange, exchange_ratio;  ///< beta_12 of a pushed box, kg/(m3 s), and over species_exchange_kinetic
  double slip = 0;                    ///< |U_1 - U_2|/sqrt(theta) of it
  Estimate pressure_ratio, viscosity_ratio, dissipation_ratio;
  double first_normal = 0, second_normal = 0;  ///< N_1/p, N_2/p
  double contact_share = 0;                    ///< of contacts in the pressure
  double contacts = 0;                         ///< pairs that touch, per particle
  double sink = 0;                             ///< W/m3, by drag on fluctuations
  double balance = 0;                          ///< -sigma_yx gamma over Gamma + sink + what is stored
  double drift = 0;                            ///< momentum of the fluctuations over the sum of its parts
  double shear_rate = 0, diameter = 0, density = 0, strain = 0, drag_rate = 0;  ///< drag_rate: 1/(gamma tau_d)
  double softness = 0, max_overlap = 0;  ///< t_c over the time between collisions; overlap over the diameter
  double cpu_seconds = 0, particle_steps = 0;
  Estimate bed_pressure, bed_balance;  ///< of a fluidised bed: by slabs and by the balance of forces, over the unit
  double bed_phi = 0;                  ///< where these are taken
  double velocity = 0;                 ///< superficial, of a fluidised bed, m/s
};

/// Writes a finished box as JSON: what a fit in Python reads.
void write_box(const std::filesystem::path& path, const BoxResult& result);

/// Runs a box of spheres in shear on one rank, or a fluidised one (bed_run.cpp). \param ranks  that share the latter
[[nodiscard]] BoxResult run_box(const core::Scene& scene, const BoxPoint& point,
                                std::shared_ptr<const core::Ranks> ranks = nullptr);
[[nodiscard]] BoxResult run_bed_box(const core::Scene& scene, const BoxPoint& point,
                                    std::shared_ptr<const core::Ranks> ranks);

}  // namespace polybed::multiscale
