// Adhesion of hard small spheres, Derjaguin, Muller and Toporov (J. Colloid Interface Sci. 53, 1975, 314): a constant
// attraction beside the Hertz force while the bodies touch. Forces along n on i, positive in repulsion.
#pragma once

#include <cmath>
#include <numbers>

namespace polybed::closures {

/// 2 pi W R*, N: greatest pull that the contact bears. \param work_of_adhesion W, J/m2
[[nodiscard]] inline double dmt_pull_off(double work_of_adhesion, double reduced_radius) {
  return 2 * std::numbers::pi * work_of_adhesion * reduced_radius;
}

/// -2 pi W R* in contact (overlap >= 0), else 0.
[[nodiscard]] inline double dmt_force(double pull_off, double overlap) { return overlap >= 0 ? -pull_off : 0; }

/// -2 pi W R* delta, J, in contact: potential energy of the pull, 0 at the touch and before.
[[nodiscard]] inline double dmt_energy(double pull_off, double overlap) {
  return overlap >= 0 ? -pull_off * overlap : 0;
}

/// W of a contact softened from E to E_soft that keeps the sticking speed: W (E_soft/E)^(2/5) (Gu, Ozel and Sundaresan,
/// Powder Technol. 296, 2016, 17). For set-up; for JKR.
[[nodiscard]] inline double softened_work_of_adhesion(double work_of_adhesion, double youngs_modulus,
                                                      double softened_modulus) {
  return work_of_adhesion * std::pow(softened_modulus / youngs_modulus, 0.4);
}

}  // namespace polybed::closures
