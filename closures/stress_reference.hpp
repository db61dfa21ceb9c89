// Closed forms that divide measured stresses of sheared particles, so that a table contains numbers near 1, and the
// numbers that select the form for a scene. phi solids fraction, gamma shear rate, theta = <v'^2>/3.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "closures/kinetic_theory.hpp"

namespace polybed::closures {

/// St_gamma = rho_p d^2 gamma/mu: inertia of a sheared particle over the liquid's drag.
[[nodiscard]] inline double stokes_of_shear(double density, double diameter, double shear_rate, double viscosity) {
  return density * diameter * diameter * shear_rate / viscosity;
}

/// Solids fraction at which sheared spheres jam, from Chialvo, Sun and Sundaresan (Phys. Rev. E 85, 2012, 021305):
/// .636 .613 .596 .587 .581 at friction 0 .1 .3 .5 1, linear between, the last beyond.
[[nodiscard]] inline double jamming_fraction(double friction) {
  constexpr std::array<double, 5> mu{0, 0.1, 0.3, 0.5, 1}, phi{0.636, 0.613, 0.596, 0.587, 0.581};
  for (std::size_t n = 1; n < mu.size(); ++n)
    if (friction < mu[n]) return phi[n - 1] + (phi[n] - phi[n - 1]) * (friction - mu[n - 1]) / (mu[n] - mu[n - 1]);
  return phi.back();
}

/// e - 1.5 mu_p exp(-3 mu_p): restitution of smooth spheres with the same losses as rough ones (the same source).
[[nodiscard]] inline double effective_restitution(double restitution, double friction) {
  return restitution - 1.5 * friction * std::exp(-3 * friction);
}

/// p/(mu_f gamma) for a suspension at St -> 0: (phi/(phi_m - phi))^2, Boyer, Guazzelli and Pouliquen (Phys. Rev. Lett.
/// 107, 2011, 188301), and its slope. Its tangent above phi_m - 0.01, so that it has no pole. phi >= 0.
[[nodiscard]] inline RadialValue viscous_stress_form(double phi, double jammed) {
  constexpr double margin = 0.01;
  const double at = std::min(phi, jammed - margin), gap = jammed - at, root = at / gap;
  const double slope = 2 * root * jammed / (gap * gap);
  return {root * root + slope * (phi - at), slope};
}

/// theta/(gamma d)^2 = mu*/Gamma* in steady simple shear without a fluid.
[[nodiscard]] inline double shear_temperature(double viscosity_star, double dissipation_star) {
  return viscosity_star / dissipation_star;
}

}  // namespace polybed::closures
