// Momentum that two species of spheres exchange in collisions while they drift slowly through each other: the limit
// that a sheared box with two species pushed apart is held against.
#pragma once

#include <cmath>
#include <numbers>

namespace polybed::closures {

/// One of the two species.
struct DriftingSpecies {
  double diameter, density, phi, theta;  ///< m, kg/m3, its own solids fraction, <v'^2>/3 in m2/s2
};

/// beta_12 = (2/3)(1+e) n_1 n_2 m_1 m_2/(m_1+m_2) d_12^2 g_12 sqrt(8 pi (theta_1 + theta_2)), kg/(m3 s): force per
/// volume over the difference of the mean velocities, of Enskog's collisions between Maxwellians that drift slowly,
/// |U_1 - U_2|
/// << sqrt(theta). At e = 1 and one temperature it is kT/(n D_12) with the first approximation of Chapman and Enskog to
/// D_12 (Chapman and Cowling 1970, 14.2); (1+e)/2 is the share of the relative speed that a collision turns round.
/// \param g12  radial distribution at contact  \param restitution  e in [0, 1]
[[nodiscard]] inline double species_exchange_kinetic(const DriftingSpecies& one, const DriftingSpecies& two, double g12,
                                                     double restitution) {
  using std::numbers::pi;
  const auto volume = [](double d) { return pi / 6 * d * d * d; };
  const double v1 = volume(one.diameter), v2 = volume(two.diameter), m1 = one.density * v1, m2 = two.density * v2;
  const double d12 = 0.5 * (one.diameter + two.diameter);
  return 2.0 / 3 * (1 + restitution) * (one.phi / v1) * (two.phi / v2) * m1 * m2 / (m1 + m2) * d12 * d12 * g12 *
         std::sqrt(8 * pi * (one.theta + two.theta));
}

}  // namespace polybed::closures
