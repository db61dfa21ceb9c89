// Collisions in a row of cells: the loops of the kinetic stress, kernels of core::in_vectors.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "closures/kinetic_theory.hpp"
#include "fluid/fluid_state.hpp"
#include "tfm/solids.hpp"

namespace polybed::tfm {

/// Properties of one species in collisions.
struct Grain {
  double density, diameter, restitution;
};

/// Cells computed together: few enough that their rows stay in the first-level cache.
struct KineticRows {
  static constexpr std::size_t most = 128;
  using Row = std::array<double, most>;
  std::size_t cells;
  /// For the solids: max(phi, 0); at least the floor of collisions; 1 down to that floor, then falling to 0 with phi.
  Row solids, phi, fade;
  Row growth;              ///< phi g0'/g0 for one size
  Row dense;               ///< factor of g0 in a mixture, 1 unless dense
  Row surface;             ///< sum_k phi_k/D_k, 1/m
  Row divergence, strain;  ///< of the motion of all solids, 1/s, 1/s2
  /// Measured stress over kinetic theory, and the slope of the first ratio in phi: 1, 0, 1, 1 without a table.
  Row pressure_ratio, pressure_ratio_slope, viscosity_ratio, loss_ratio;

  /// For one species.
  Row g0, collisions;                        ///< sum_k x_k g_jk; sum_k h_jk
  Row viscosity;                             ///< mu_j/(phi s), kg/m2, s = sqrt theta
  Row compression, shear, loss, drag, slip;  ///< factors of theta, s, s^3, theta, 1/s in the energy balance, W/m3
  Row speed;                                 ///< s, m/s
  Row speed_fall;                            ///< -ds/dcompression, m4 s/kg; 0 if theta is an unknown
};

/// Least solids fraction at which collisions are evaluated: the mean free path is 12 diameters there, and its effect on
/// shear and compression would grow as 1/phi^2. Below it all effects of collisions fade with phi, so that slip and drag
/// alone set the temperature in an empty cell. The stress and its work fade alike; otherwise dilute solids that fly
/// apart would gain energy that they do not lose.
inline constexpr double collision_fraction_floor = 0.01;

/// Sets the rows of the solids, and clears those that are sums. \param dense  g0 above freezing is Torquato's
inline void begin_rows(KineticRows& rows, const double* solids_fraction, bool dense) {
  const std::size_t cells = rows.cells;
  for (std::size_t c = 0; c < cells; ++c) {
    rows.solids[c] = std::max(solids_fraction[c], 0.0);
    rows.phi[c] = std::max(rows.solids[c], collision_fraction_floor);
    rows.fade[c] = std::min(rows.solids[c] * (1 / collision_fraction_floor), 1.0);
    rows.surface[c] = rows.divergence[c] = rows.strain[c] = 0;
  }
  for (std::size_t c = 0; c < cells; ++c) {
    const closures::RadialValue gas = closures::radial_carnahan_starling(rows.phi[c]);
    const closures::RadialValue radial = dense ? closures::radial_distribution_dense(rows.phi[c]) : gas;
    rows.growth[c] = rows.phi[c] * radial.slope / radial.value;
    rows.dense[c] = radial.value / gas.value;
  }
  for (KineticRows::Row* one : {&rows.pressure_ratio, &rows.viscosity_ratio, &rows.loss_ratio})
    std::fill_n(one->begin(), cells, 1);
  std::fill_n(rows.pressure_ratio_slope.begin(), cells, 0);
}

/// Adds a species to the surface. \param share  x_k
inline void add_surface(KineticRows& rows, const double* share, double diameter) {
  const double per_diameter = 1 / diameter;
  for (std::size_t c = 0; c < rows.cells; ++c) rows.surface[c] += share[c] * rows.phi[c] * per_diameter;
}

/// Adds a species' part, phi_j U_j, to U of all solids, by volume, on faces; `end_flow` divides by phi.
inline void add_flow(const double* fraction, const double* velocity, std::ptrdiff_t stride, std::size_t faces,
                     double* flow) {
  const double* below = fraction - stride;
  for (std::size_t f = 0; f < faces; ++f) flow[f] += 0.5 * (below[f] + fraction[f]) * velocity[f];
}

inline void end_flow(const double* solids_fraction, std::ptrdiff_t stride, std::size_t faces, double* flow) {
  const double* below = solids_fraction - stride;
  for (std::size_t f = 0; f < faces; ++f)
    flow[f] /= std::max(0.5 * (below[f] + solids_fraction[f]), stress_fraction_floor);
}

/// Adds (high - low) / spacing to the divergence.
inline void add_divergence(KineticRows& rows, const double* low, const double* high, double spacing) {
  const double per_length = 1 / spacing;
  for (std::size_t c = 0; c < rows.cells; ++c) rows.divergence[c] += (high[c] - low[c]) * per_length;
}

/// Adds a species to the strain. \param strain  2 D'_j:D'_j
inline void add_strain(KineticRows& rows, const double* share, const double* strain) {
  for (std::size_t c = 0; c < rows.cells; ++c) rows.strain[c] += share[c] * strain[c];
}

/// Adds the contribution of another species, or its own, to g0 and collisions of a species.
/// \param share  x_k of the neighbours
inline void add_neighbours(KineticRows& rows, const double* share, const Grain& grain, const Grain& neighbour) {
  const double d = grain.diameter, reach = neighbour.diameter;
  const double mass_ratio = grain.density * d * d * d / (neighbour.density * reach * reach * reach);
  const double e = 0.5 * (grain.restitution + neighbour.restitution);
  for (std::size_t c = 0; c < rows.cells; ++c) {
    const double g = rows.dense[c] * closures::radial_of_pair(1 - rows.phi[c], rows.surface[c], d, reach);
    rows.g0[c] += share[c] * g;
    rows.collisions[c] += closures::mixture_pressure_of_pair(share[c] * rows.phi[c], g, e, d, reach, mass_ratio);
  }
}

/// The fluid and a species in it, row by row.
struct SlipRows {
  const double *slip_superficial, *voidage, *exchange;
  double viscosity;
};

/// Sets the coefficients in a species' balance of fluctuation energy, from g0 and collisions.
inline void set_balance(KineticRows& rows, closures::KineticModel model, const Grain& grain, const SlipRows& fluid) {
  const double rho = grain.density, d = grain.diameter, e = grain.restitution;
  for (std::size_t c = 0; c < rows.cells; ++c) {
    const double phi = rows.phi[c], g0 = rows.g0[c], per_phi = 1 / phi;
    const double slip = fluid.slip_superficial[c] / std::max(fluid.voidage[c], fluid::voidage_floor);
    rows.compression[c] = rows.fade[c] * rho * (1 + rows.collisions[c]) * rows.divergence[c] * rows.pressure_ratio[c];
    rows.viscosity[c] =
        rows.fade[c] * closures::kinetic_viscosity(model, phi, g0, e) * (rho * d) * per_phi * rows.viscosity_ratio[c];
    rows.shear[c] = rows.viscosity[c] * rows.strain[c];
    rows.loss[c] = closures::kinetic_dissipation(model, phi, g0, e) * (rho / d) * per_phi * rows.loss_ratio[c];
    rows.drag[c] = closures::fluctuation_drag_sink(fluid.exchange[c], 1);
    rows.slip[c] = closures::slip_production(phi, g0, fluid.viscosity, slip, d, rho);
  }
}

/// Computes the speed from the local balance, and the corresponding temperature.
inline void balance_speed(KineticRows& rows, double* temperature) {
  for (std::size_t c = 0; c < rows.cells; ++c) {
    const double s =
        closures::balanced_speed(rows.loss[c], rows.drag[c] + rows.compression[c], rows.shear[c], rows.slip[c]);
    rows.speed[c] = s;
    rows.speed_fall[c] = closures::fall_of_balanced_speed(rows.loss[c], rows.shear[c], rows.slip[c], s);
    temperature[c] = s * s;
  }
}

/// The speed for a temperature that is an unknown.
inline void take_speed(KineticRows& rows, const double* temperature) {
  for (std::size_t c = 0; c < rows.cells; ++c) {
    rows.speed[c] = std::sqrt(std::max(temperature[c], 0.0));
    rows.speed_fall[c] = 0;
  }
}

/// Input from collisions to the equation of the granular temperature.
struct TemperatureRows {
  const double* temperature;
  double *rate, *conductivity, *decay;
  double least_agitation;      ///< m/s, regularises the slip production at 0
  double conduction_diagonal;  ///< 1/m2
};

/// Local part of dtheta/dt, the conductivity, and the decay rate of a disturbance of theta.
inline void set_temperature_rate(const KineticRows& rows, const Grain& grain, const TemperatureRows& out) {
  const double per_energy = 2 / (3 * grain.density), least2 = out.least_agitation * out.least_agitation;
  const double mass = grain.density * grain.diameter, diagonal = out.conduction_diagonal, e = grain.restitution;
  for (std::size_t c = 0; c < rows.cells; ++c) {
    const double theta = out.temperature[c], s = rows.speed[c], rounded = std::max(theta, 0.0) + least2;
    const double slip = rows.slip[c] / std::sqrt(rounded);
    const double conductivity =
        rows.fade[c] * closures::kinetic_conductivity(rows.phi[c], rows.g0[c], e) * mass * s / rows.phi[c];
    out.rate[c] =
        per_energy * (rows.shear[c] * s - (rows.compression[c] + rows.drag[c] + rows.loss[c] * s) * theta + slip);
    out.conductivity[c] = conductivity;
    out.decay[c] =
        per_energy * (rows.drag[c] + 1.5 * rows.loss[c] * s + 0.5 * slip / rounded + diagonal * conductivity);
  }
}

/// Sums of the species' stresses.
struct StressRows {
  double *pressure, *slope, *damping, *viscosity;
};

/// Adds a species to pressure, its slope, its response to compression through theta, and viscosity of the solids.
inline void add_stress(const KineticRows& rows, const double* share, double density, const StressRows& to) {
  for (std::size_t c = 0; c < rows.cells; ++c) {
    const double one = 1 + rows.collisions[c], rise = 1 + rows.collisions[c] * (2 + rows.growth[c]);
    const double energy = rows.fade[c] * share[c] * density * rows.speed[c] * rows.speed[c];
    to.pressure[c] += rows.solids[c] * energy * one * rows.pressure_ratio[c];
    to.slope[c] += energy * (rise * rows.pressure_ratio[c] + rows.phi[c] * one * rows.pressure_ratio_slope[c]);
    const double pressed = rows.fade[c] * density * one * rows.pressure_ratio[c];  // p/(phi theta), compression/div U
    to.damping[c] += 2 * share[c] * pressed * pressed * rows.speed[c] * rows.speed_fall[c];
    to.viscosity[c] += share[c] * rows.viscosity[c] * rows.speed[c];
  }
}

}  // namespace polybed::tfm
