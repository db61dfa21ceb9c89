// Pendular liquid bridge between two spheres, Willett, Adams, Johnson and Seville (Langmuir 16, 2000, 9396), closed
// form:
//   F = 2 pi R gamma cos(theta)/(1 + 1.05 s + 2.5 s^2),  s = S sqrt(R/V),
// for small bridges (V/R^3 <= 0.001, theta < 50 degrees; beyond it extends smoothly). Spheres of two sizes after
// Derjaguin: R = 2 R*. Force along n on i, positive in repulsion.
#pragma once

#include <cmath>
#include <numbers>

namespace polybed::closures {

/// Constants of a bridge.
struct CapillaryBridge {
  double pull_off;  ///< 2 pi R gamma cos(theta), N
  double scale;     ///< sqrt(V/R), m: s = S/scale
  double rupture;   ///< gap at which it breaks, m
};

/// Rupture at (1 + theta/2) V^(1/3), theta in radians (Lian, Thornton and Adams, J. Colloid Interface Sci. 161, 1993,
/// 138). For set-up. \param volume V, m3, > 0  \param contact_angle theta, radians
[[nodiscard]] inline CapillaryBridge capillary_bridge(double surface_tension, double contact_angle, double volume,
                                                      double reduced_radius) {
  const double radius = 2 * reduced_radius;
  return {2 * std::numbers::pi * radius * surface_tension * std::cos(contact_angle), std::sqrt(volume / radius),
          (1 + 0.5 * contact_angle) * std::cbrt(volume)};
}

/// Force of a bridge that exists; whole in contact, 0 beyond rupture. It forms at contact only: a state of the pair.
[[nodiscard]] inline double capillary_force(const CapillaryBridge& bridge, double gap) {
  const double open = gap > 0 ? gap : 0, s = open / bridge.scale;
  return open > bridge.rupture ? 0 : -bridge.pull_off / (1 + s * (1.05 + 2.5 * s));
}

}  // namespace polybed::closures
