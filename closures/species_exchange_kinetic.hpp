// Momentum exchange between two species of spheres that collide while they drift through each other, from slow drift,
// the diffusion of one through the other, to two opposed streams. It is the reference for a sheared box with two
// species pushed apart, and the factor of the table from such boxes.
#pragma once

#include <cmath>
#include <numbers>

namespace polybed::closures {

/// One of the two species.
struct DriftingSpecies {
  double diameter, density, phi, theta;  ///< m, kg/m3, its own solids fraction, <v'^2>/3 in m2/s2
};

/// Drift factor of the force between two Maxwellians of spheres that drift at w = s sqrt(2 (theta_1 + theta_2)),
/// relative to slow drift:
///   (3 sqrt(pi)/(8 s)) [(s + 1/(2 s)) exp(-s^2)/sqrt(pi) + (s^2 + 1 - 1/(4 s^2)) erf(s)] = 1 + s^2/5 - s^4/70 + ...,
/// 3 sqrt(pi) s/8 at s -> infinity. From a sphere in a gas by Epstein (Phys. Rev. 23, 1924, 710-733); two Maxwellians
/// are the same case with the sum of their variances. s >= 0.
[[nodiscard]] inline double drift_factor(double s) {
  constexpr double root_pi = 1 / std::numbers::inv_sqrtpi;
  const double x = s * s;
  // The closed form loses 1/s^2 units in the last place; the next term of the series is s^6/630.
  if (s < 0.02) return 1 + x / 5 - x * x / 70;
  if (s > 6) return 3 * root_pi / 8 * (s + (1 - 0.25 / x) / s);  // exp(-36) and 1 - erf(6) are below rounding
  return 3 * root_pi / (8 * s) *
         ((s + 0.5 / s) * std::exp(-x) * std::numbers::inv_sqrtpi + (x + 1 - 0.25 / x) * std::erf(s));
}

/// beta_12 = (2/3)(1+e) n_1 n_2 m_1 m_2/(m_1+m_2) d_12^2 g_12 sqrt(8 pi (theta_1 + theta_2)) drift_factor(s), kg/(m3
/// s): force per volume over the difference of the mean velocities, from Enskog's collisions between Maxwellians. At
/// slow drift, e = 1 and one temperature it is kT/(n D_12) with the first approximation of Chapman and Enskog to D_12
/// (Chapman and Cowling 1970, 14.2); (1+e)/2 is the share of the relative speed that a collision reverses. At fast
/// drift, or without agitation, it equals species_exchange_syamlal.hpp for smooth spheres.
/// \param g12  radial distribution at contact  \param restitution  e in [0, 1]
/// \param drift  w = |U_1 - U_2|, m/s
[[nodiscard]] inline double species_exchange_kinetic(const DriftingSpecies& one, const DriftingSpecies& two, double g12,
                                                     double restitution, double drift) {
  using std::numbers::pi;
  const auto volume = [](double d) { return pi / 6 * d * d * d; };
  const double v1 = volume(one.diameter), v2 = volume(two.diameter), m1 = one.density * v1, m2 = two.density * v2;
  const double d12 = 0.5 * (one.diameter + two.diameter);
  const double agitation = std::sqrt(2 * (one.theta + two.theta));
  // Above s = 1e8 the thermal part is below rounding, and s itself would overflow at rest.
  const double speed =
      agitation > 1e-8 * drift ? agitation * drift_factor(drift / agitation) : 3 / std::numbers::inv_sqrtpi / 8 * drift;
  return 4.0 / 3 * (1 + restitution) * (one.phi / v1) * (two.phi / v2) * m1 * m2 / (m1 + m2) * d12 * d12 * g12 * speed /
         std::numbers::inv_sqrtpi;
}

}  // namespace polybed::closures
