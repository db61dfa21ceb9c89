// Pendular liquid bridge between two spheres: capillary force for a volume V as a function of the gap s.
//   F = 2 pi R gamma cos(theta)/(1 + 1.05 s* + 2.5 s*^2),  s* = s sqrt(R/V)
// (Willett, Adams, Johnson and Seville, Langmuir 16, 2000, 9396, the closed form for small bridges, there in half the
// gap: 1 + 2.1 S + 10 S^2). R is Derjaguin's radius 2 R* = 2 R_i R_j/(R_i + R_j), 2 R_i for a wall. The bridge ruptures
// at s_c = (1 + theta/2) V^(1/3) (Lian, Thornton and Adams, J. Colloid Interface Sci. 161, 1993, 138). Forces along n
// on i, positive in repulsion.
//
// Compared with the Young-Laplace equation the attraction of a wetting liquid in contact is 4 to 22 % too strong for
// V/R^3 from 1e-4 to 0.056, and 12 to 19 % too weak near rupture; the error grows with the contact angle. The same
// formulas are used outside that range. Weight and viscosity of the liquid are neglected.
#pragma once

#include <cmath>
#include <numbers>

namespace polybed::closures {

/// Share of a sphere's surface that another in contact covers, seen from the sphere's centre: the cap of half-angle
/// asin(R_j/(R_i + R_j)), [1 - sqrt(1 - (R_j/(R_i + R_j))^2)]/2 (Shi and McCarthy, Powder Technol. 184, 2008, 64). Caps
/// of spheres that do not overlap are disjoint, so that these shares sum to at most 1.
/// \param partner R_j; infinity: a wall, which covers 1/2
[[nodiscard]] inline double covered_share(double radius, double partner) {
  const double sine = 1 / (1 + radius / partner);
  return 0.5 * (1 - std::sqrt(1 - sine * sine));
}

/// 2 pi R gamma cos(theta), N: greatest attraction, in contact. \param radius R, m \param surface_tension gamma, N/m
/// \param contact_angle theta, rad, 0 to pi/2
[[nodiscard]] inline double liquid_bridge_pull(double radius, double surface_tension, double contact_angle) {
  return 2 * std::numbers::pi * radius * surface_tension * std::cos(contact_angle);
}

/// (1 + theta/2) V^(1/3), m: gap at which the bridge ruptures. For set-up.
[[nodiscard]] inline double liquid_bridge_rupture(double volume, double contact_angle) {
  return (1 + 0.5 * contact_angle) * std::cbrt(volume);
}

/// Force of a bridge, N; in contact (gap <= 0) as for gap 0. \param pull from liquid_bridge_pull() \param stretch
/// sqrt(R/V), 1/m
[[nodiscard]] inline double liquid_bridge_force(double pull, double stretch, double gap) {
  const double s = gap > 0 ? gap * stretch : 0;
  return -pull / (1 + (1.05 + 2.5 * s) * s);
}

/// Energy of a bridge, J: minus the work from this gap to rupture; linear in contact. Integral of F: with q = sqrt(10 -
/// 1.05^2), (2/q) atan((5 s* + 1.05)/q) is the integral of 1/(1 + 1.05 s* + 2.5 s*^2).
[[nodiscard]] inline double liquid_bridge_energy(double pull, double stretch, double rupture, double gap) {
  constexpr double q = 2.982867747654931;
  const auto integral = [&](double s) { return 2 / q * std::atan((5 * s + 1.05) / q); };
  const double open = gap > 0 ? gap : 0;
  return -pull * ((integral(rupture * stretch) - integral(open * stretch)) / stretch - (gap - open));
}

}  // namespace polybed::closures
