// What collisions do in a row of cells: the loops of the kinetic stress, which run at vector speed.
#pragma once

#include <array>
#include <cstddef>

#include "closures/kinetic_theory.hpp"

namespace polybed::tfm {

/// One species as collisions see it.
struct Grain {
  double density, diameter, restitution;
};

/// Cells that are worked on together: few enough that their rows stay in the processor's first cache.
struct KineticRows {
  static constexpr std::size_t most = 128;
  using Row = std::array<double, most>;
  std::size_t cells;
  /// Of the solids: max(phi, 0); at least the floor of collisions; 1 down to that floor, then falling to 0 with phi.
  Row solids, phi, fade;
  Row growth;              ///< phi g0'/g0 of one size
  Row dense;               ///< what g0 of a mixture is multiplied by, 1 unless dense
  Row surface;             ///< sum_k phi_k/D_k, 1/m
  Row divergence, strain;  ///< of the motion of all solids, 1/s, 1/s2
  /// What a measured stress is to kinetic theory, and the slope of the first with phi: 1, 0, 1, 1 without a table.
  Row pressure_ratio, pressure_ratio_slope, viscosity_ratio, loss_ratio;

  /// Of one species.
  Row g0, collisions;                        ///< sum_k x_k g_jk; sum_k h_jk
  Row viscosity;                             ///< mu_j/(phi s), kg/m2, s = sqrt theta
  Row compression, shear, loss, drag, slip;  ///< of theta, s, s^3, theta, 1/s in the balance of energy, W/m3
  Row speed;                                 ///< s, m/s
};

/// Sets the rows of the solids, and clears those that are sums. \param dense  g0 above freezing is Torquato's
void begin_rows(KineticRows& rows, const double* solids_fraction, bool dense);

/// Adds a species to the surface. \param share  x_k
void add_surface(KineticRows& rows, const double* share, double diameter);

/// U of all solids, by volume, on faces: adds a species' part, phi_j U_j; `end_flow` divides by phi.
void add_flow(const double* fraction, const double* velocity, std::ptrdiff_t stride, std::size_t faces, double* flow);
void end_flow(const double* solids_fraction, std::ptrdiff_t stride, std::size_t faces, double* flow);

/// Adds (high - low) / spacing to the divergence.
void add_divergence(KineticRows& rows, const double* low, const double* high, double spacing);

/// Adds a species to the strain. \param strain  2 D'_j:D'_j
void add_strain(KineticRows& rows, const double* share, const double* strain);

/// Adds to g0 and collisions of a species what its neighbours of another do, or of its own.
/// \param share  x_k of the neighbours
void add_neighbours(KineticRows& rows, const double* share, const Grain& grain, const Grain& neighbour);

/// The fluid and a species in it, row by row.
struct SlipRows {
  const double *slip_superficial, *voidage, *exchange;
  double viscosity;
};

/// Sets the factors of the balance of fluctuation energy of a species, from g0 and collisions.
void set_balance(KineticRows& rows, closures::KineticModel model, const Grain& grain, const SlipRows& fluid);

/// The speed from the local balance, and the temperature that it means.
void balance_speed(KineticRows& rows, double* temperature);

/// The speed of a temperature that is an unknown.
void take_speed(KineticRows& rows, const double* temperature);

/// What the equation of the granular temperature takes from collisions.
struct TemperatureRows {
  const double* temperature;
  double *rate, *conductivity, *decay;
  double least_agitation;      ///< m/s, rounds off the slip production at 0
  double conduction_diagonal;  ///< 1/m2
};

/// Local part of dtheta/dt, the conductivity, and how fast a disturbance of theta decays.
void set_temperature_rate(const KineticRows& rows, const Grain& grain, const TemperatureRows& out);

/// Adds a species to pressure, its slope and viscosity of the solids.
void add_stress(const KineticRows& rows, const double* share, double density, double* pressure, double* slope,
                double* viscosity);

}  // namespace polybed::tfm
