// Attraction of two spheres across a gap much smaller than their radii (Hamaker, Physica 4, 1937, 1058; Israelachvili,
// Intermolecular and Surface Forces, 2011, fig. 13.1). Force along n on i, positive in repulsion.
#pragma once

#include <cmath>

namespace polybed::closures {

/// -A R*/(6 z^2), N, with the gap z at least z_0, the distance of surfaces in contact.
/// \param hamaker A, J  \param reduced_radius R* of the spheres, or of asperities  \param least_gap z_0, about 0.4 nm
[[nodiscard]] inline double van_der_waals_force(double hamaker, double reduced_radius, double least_gap, double gap) {
  const double z = gap > least_gap ? gap : least_gap;
  return -hamaker * reduced_radius / (6 * z * z);
}

/// -A R*/(6 z), J: energy of the attraction, 0 far apart; linear below the least gap, where the force is constant.
[[nodiscard]] inline double van_der_waals_energy(double hamaker, double reduced_radius, double least_gap, double gap) {
  const double z = gap > least_gap ? gap : least_gap, within = gap > least_gap ? 0 : least_gap - gap;
  return -hamaker * reduced_radius / (6 * z) * (1 + within / z);
}

/// A R*/(6 z_0^2), N: greatest attraction.
[[nodiscard]] inline double van_der_waals_pull_off(double hamaker, double reduced_radius, double least_gap) {
  return hamaker * reduced_radius / (6 * least_gap * least_gap);
}

/// Gap above which the attraction is below a force, m: sqrt(A R*/(6 F)). For set-up: the range of the effect.
[[nodiscard]] inline double van_der_waals_reach(double hamaker, double reduced_radius, double force) {
  return std::sqrt(hamaker * reduced_radius / (6 * force));
}

}  // namespace polybed::closures
