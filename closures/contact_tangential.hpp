// Tangential contact: springs, the Coulomb limit, which rescales the history, and the rotation of the history with the
// pair. Forces act on i; v_t is the tangential velocity of i relative to j at the contact; xi the tangential
// displacement. One step: xi = transported(xi, n) + v_t dt; force of spring and dashpot, times coulomb_share. The first
// step of a contact counts from first contact: xi = v_t time_since_touch.
#pragma once

#include <cmath>

#include "closures/vec3.hpp"

namespace polybed::closures {

/// S_t = 8 G* a, N/m, for two spheres without slip (Mindlin, J. Appl. Mech. 16, 1949, 259).
[[nodiscard]] inline double tangential_stiffness(double shear_modulus, double contact_radius) {
  return 8 * shear_modulus * contact_radius;
}

/// (2/3) S_t, N/m: secant stiffness in the law "hdd" (Di Renzo and Di Maio, Chem. Eng. Sci. 60, 2005, 1303), the
/// integral of dF_t = 8 G* a dxi along xi proportional to the overlap.
[[nodiscard]] inline double secant_stiffness_hdd(double shear_modulus, double contact_radius) {
  return 16.0 / 3 * shear_modulus * contact_radius;
}

/// c_t/c_n = sqrt(S_t/S_n) = sqrt(4 G*/E*), constant for a pair of materials.
[[nodiscard]] inline double tangential_damping_ratio(double shear_modulus, double youngs_modulus) {
  return std::sqrt(4 * shear_modulus / youngs_modulus);
}

/// -k_t xi - c_t v_t, without limit.
[[nodiscard]] inline Vec3 spring_force(double stiffness, const Vec3& displacement, double damping,
                                       const Vec3& velocity) {
  return {-stiffness * displacement.x - damping * velocity.x, -stiffness * displacement.y - damping * velocity.y,
          -stiffness * displacement.z - damping * velocity.z};
}

/// Share of S_t in the first step of a contact, for laws that sum over steps: the mean of a over the step, along xi
/// proportional to the overlap, over a at its end.
inline constexpr double first_step_share = 2.0 / 3;

/// Spring force after one step in the law "mindlin", without dashpot: F - S_t v_t dt. When the contact shrinks, F is
/// first multiplied by a_new/a_old; otherwise a closed path of xi and overlap would generate energy. Radii > 0; the
/// first step of a contact is -(2/3) S_t v_t time_since_touch, the integral over it.
[[nodiscard]] inline Vec3 mindlin_force(const Vec3& spring, double radius_old, double radius_new, double stiffness,
                                        const Vec3& velocity, double time_step) {
  const double ratio = radius_new / radius_old, share = ratio < 1 ? ratio : 1, change = stiffness * time_step;
  return {share * spring.x - change * velocity.x, share * spring.y - change * velocity.y,
          share * spring.z - change * velocity.z};
}

/// mu F_n/|F_t| if the force exceeds mu F_n, else 1; 0 for F_n <= 0 with a force.
/// \param force_squared |F_t|^2  \param limit mu F_n, N
[[nodiscard]] inline double coulomb_share(double force_squared, double limit) {
  constexpr double least = 1e-300;  // N2: a zero force has no direction, and its share is the limit for vanishing force
  const double bound = limit > 0 ? limit : 0;
  const double share = bound / std::sqrt(force_squared > least ? force_squared : least);
  return share < 1 ? share : 1;
}

/// Part of a step during which the bodies have touched, s: overlap/(-v_n) in the first step of a contact, dt in every
/// later one. No flag is needed: a contact is new if overlap + v_n dt < 0. This matters: a spring charged with the
/// whole first step exceeds friction and slides, and continues to slide, as a sliding spring also contains the
/// dashpot's share. Oblique impacts below the angle of sliding then leave, at 200 steps per contact, with a speed wrong
/// by up to 3 % of the initial one.
/// \param normal_velocity v_n that produced the overlap: at the half step, which moved the bodies
[[nodiscard]] inline double time_since_touch(double overlap, double normal_velocity, double time_step) {
  const double closed = -normal_velocity * time_step;
  return closed > overlap ? overlap / -normal_velocity : time_step;
}

/// Rotates the history into the tangential plane of the present n (unit): removes its part along n and keeps its
/// length. A history along n becomes 0. For displacements and forces.
[[nodiscard]] inline Vec3 transported(const Vec3& history, const Vec3& n) {
  const double along = dot(history, n);
  const Vec3 in_plane = history - along * n;
  const double was = dot(history, history), is = dot(in_plane, in_plane);
  const double scale = is > 0 ? std::sqrt(was / (is > 0 ? is : 1.0)) : 0;
  return scale * in_plane;
}

}  // namespace polybed::closures
