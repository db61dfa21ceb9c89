// Limits of the time step of particles in contact.
#pragma once

#include <cmath>
#include <numbers>

namespace polybed::closures {

/// Time in which a Rayleigh wave crosses half a particle: pi R sqrt(rho/G)/(0.1631 nu + 0.8766), s, G = E/(2 (1 + nu)).
[[nodiscard]] inline double rayleigh_time(double radius, double density, double youngs_modulus, double poisson_ratio) {
  const double shear_modulus = youngs_modulus / (2 * (1 + poisson_ratio));
  return std::numbers::pi * radius * std::sqrt(density / shear_modulus) / (0.1631 * poisson_ratio + 0.8766);
}

/// Greatest stable step of one damped contact, s, with the force at full-step positions and half-step velocities,
/// T(2.11)-(2.13): dt omega < 2 (sqrt(1 + zeta^2) - zeta). \param omega  sqrt(S_n/m*), 1/s  \param zeta  damping ratio
[[nodiscard]] inline double greatest_step_of_thesis(double omega, double zeta) {
  return 2 * (std::sqrt(1 + zeta * zeta) - zeta) / omega;
}

/// Likewise with velocities brought to the time of the positions: dt omega < 2 (sqrt(1 + 4 zeta^2) - 2 zeta).
[[nodiscard]] inline double greatest_step_synchronised(double omega, double zeta) {
  return 2 * (std::sqrt(1 + 4 * zeta * zeta) - 2 * zeta) / omega;
}

}  // namespace polybed::closures
