// Minimum fluidisation velocity of a bed of spheres, from a correlation.
#pragma once

#include <cmath>

namespace polybed::closures {

/// u_mf, m/s >= 0, superficial: Re_mf = sqrt(33.7^2 + 0.0408 Ar) - 33.7 (Wen and Yu, AIChE J. 12 (1966) 610), with Ar =
/// rho_f |rho_s - rho_f| g D^3/mu^2. Fitted to beds at Re_mf 0.001 to 4000; defined for any positive numbers, and for
/// small Ar without loss of digits: Re_mf = 0.0408 Ar/(sqrt(33.7^2 + 0.0408 Ar) + 33.7).
/// \param diameter       D, m
/// \param excess         |rho_s - rho_f|, kg/m3
/// \param fluid_density  rho_f, kg/m3
/// \param viscosity      mu, Pa s, > 0
/// \param gravity        g, m/s2
[[nodiscard]] inline double minimum_fluidisation(double diameter, double excess, double fluid_density, double viscosity,
                                                 double gravity) {
  const double kinematic = viscosity / fluid_density;
  const double archimedes =
      std::abs(excess) / fluid_density * gravity * diameter * diameter * diameter / (kinematic * kinematic);
  const double part = 0.0408 * archimedes;
  return part / (std::sqrt(33.7 * 33.7 + part) + 33.7) * kinematic / diameter;
}

}  // namespace polybed::closures
