// The velocity that a particle's own drag gives to the averaged fluid at its position. It must not be mistaken for the
// velocity of the surrounding fluid (Horwitz and Mani, J. Comput. Phys. 318, 2016, 85; Balachandar, Liu and Lakhote, J.
// Comput. Phys. 376, 2019, 160; Evrard et al., arXiv:2405.08188).
#pragma once

#include <cmath>
#include <numbers>

namespace polybed::closures {

/// Velocity at the position of a steady force that moves through an unbounded fluid, over its value without inertia,
/// where force and observed velocity are both averaged with Gaussians. Oseen's equations: psi = (3/2) int_0^1 (1 - x^2)
/// [1 - c b g(b)] dx, b = x R, c = sqrt(pi/2), g(b) = exp(b^2/2) erfc(b/sqrt 2), in closed form; 1 - (3/8) c R for
/// small R, (3/2) c/R for large R.
/// \param reynolds  R = rho U s/mu, at least 0, with the spread s of own_wake()
[[nodiscard]] inline double own_wake_inertia(double reynolds) {
  const double r = reynolds, c = std::sqrt(std::numbers::pi / 2);
  if (r < 1e-2) return 1 - 0.375 * c * r + 0.2 * r * r;
  // exp(r^2/2) overflows; the series is accurate to 1e-9 from here on.
  const double q = 1 / (r * r);
  const double g = r < 20 ? std::exp(0.5 * r * r) * std::erfc(r / std::numbers::sqrt2)
                          : (1 - q * (1 - 3 * q * (1 - 5 * q * (1 - 7 * q)))) / (c * r);
  const double first = g - 1 + r / c, third = r * r * g - 2 * first + r * r * r / (3 * c);
  return 1 - 1.5 * c * (first - third * q) / r;
}

/// Velocity over the force, m/(s N): sqrt(2/pi) psi(R)/(6 pi mu s).
/// \param viscosity  mu, Pa s  \param density  rho, kg/m3  \param spread  s, m, > 0: standard deviation, along an axis,
/// of the product of the kernels for force and velocity  \param speed  U, m/s
[[nodiscard]] inline double own_wake(double viscosity, double density, double spread, double speed) {
  const double creeping = std::sqrt(2 / std::numbers::pi) / (6 * std::numbers::pi * viscosity * spread);
  return creeping * own_wake_inertia(density * speed * spread / viscosity);
}

}  // namespace polybed::closures
