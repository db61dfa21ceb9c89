// Attraction of two spheres across a gap much smaller than they are (Hamaker, Physica 4, 1937, 1058; Israelachvili,
// Intermolecular and Surface Forces, 2011, fig. 13.1). Force along n on i, positive in repulsion.
#pragma once

#include <cmath>

namespace polybed::closures {

/// -A R*/(6 z^2), N, z the gap, at least z_0: in contact the surfaces stay that far apart.
/// \param hamaker A, J  \param reduced_radius R* of the spheres, or of asperities  \param least_gap z_0, m, about 0.4 nm
[[nodiscard]] inline double van_der_waals_force(double hamaker, double reduced_radius, double least_gap, double gap) {
  const double z = gap > least_gap ? gap : least_gap;
  return -hamaker * reduced_radius / (6 * z * z);
}

/// -A R*/(6 z), J: energy of the pull, 0 far apart; linear below the least gap, where the pull is constant.
[[nodiscard]] inline double van_der_waals_energy(double hamaker, double reduced_radius, double least_gap, double gap) {
  const double z = gap > least_gap ? gap : least_gap, within = gap > least_gap ? 0 : least_gap - gap;
  return -hamaker * reduced_radius / (6 * z) * (1 + within / z);
}

/// A R*/(6 z_0^2), N: greatest pull.
[[nodiscard]] inline double van_der_waals_pull_off(double hamaker, double reduced_radius, double least_gap) {
  return hamaker * reduced_radius / (6 * least_gap * least_gap);
}

/// Gap beyond which the pull is below a force, m: sqrt(A R*/(6 F)). For set-up: the reach of the effect.
[[nodiscard]] inline double van_der_waals_reach(double hamaker, double reduced_radius, double force) {
  return std::sqrt(hamaker * reduced_radius / (6 * force));
}

}  // namespace polybed::closures
