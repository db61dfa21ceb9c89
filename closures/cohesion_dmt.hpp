// Adhesion of hard small spheres, Derjaguin, Muller and Toporov (J. Colloid Interface Sci. 53, 1975, 314): a constant
// attraction in addition to the Hertz force during contact. Forces along n on i, positive in repulsion.
#pragma once

#include <numbers>

namespace polybed::closures {

/// 2 pi W R*, N: the contact's greatest tensile force. \param work_of_adhesion W, J/m2
[[nodiscard]] inline double dmt_pull_off(double work_of_adhesion, double reduced_radius) {
  return 2 * std::numbers::pi * work_of_adhesion * reduced_radius;
}

/// -2 pi W R* in contact (overlap >= 0), else 0.
[[nodiscard]] inline double dmt_force(double pull_off, double overlap) { return overlap >= 0 ? -pull_off : 0; }

/// -2 pi W R* delta, J, in contact: potential energy of the attraction, 0 at first contact and before.
[[nodiscard]] inline double dmt_energy(double pull_off, double overlap) {
  return overlap >= 0 ? -pull_off * overlap : 0;
}

}  // namespace polybed::closures
