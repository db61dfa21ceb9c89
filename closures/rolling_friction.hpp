// Moments that resist rolling (Ai, Chen, Rotter and Ooi, Powder Technol. 206, 2011, 269): type A, a constant torque
// ("cdt"), and type C, an elastic-plastic spring and dashpot ("epsd"). Moments act on i, and on j with the opposite
// sign; w_rel = w_i - w_j.
#pragma once

#include <cmath>

#include "closures/vec3.hpp"

namespace polybed::closures {

/// Moment and its history: the moment of the spring, N m.
struct RollingMoment {
  Vec3 moment, spring;
};

/// mu_r R* F_n, N m, at least 0: greatest moment of both laws.
[[nodiscard]] inline double rolling_limit(double rolling_friction, double reduced_radius, double normal_force) {
  return normal_force > 0 ? rolling_friction * reduced_radius * normal_force : 0;
}

/// cdt: -mu_r R* F_n w_rel/|w_rel|; zero without relative spin. For moving contacts: at rest it oscillates.
[[nodiscard]] inline Vec3 rolling_cdt(double limit, const Vec3& relative_spin) {
  const double spin_squared = dot(relative_spin, relative_spin);
  const bool turns = spin_squared > 0;
  return (turns ? -limit / std::sqrt(turns ? spin_squared : 1.0) : 0) * relative_spin;
}

/// k_r = 2.25 k_n mu_r^2 R*^2, N m, k_n = F_n/delta.
[[nodiscard]] inline double rolling_stiffness(double normal_stiffness, double rolling_friction, double reduced_radius) {
  const double arm = rolling_friction * reduced_radius;
  return 2.25 * normal_stiffness * arm * arm;
}

/// 1/I_r = sum 1/(I + m R^2), kg m2: inertia of rolling about the contact; infinite I and m for a wall.
[[nodiscard]] inline double rolling_inertia(double inertia_i, double mass_i, double radius_i, double inertia_j,
                                            double mass_j, double radius_j) {
  return 1 / (1 / (inertia_i + mass_i * radius_i * radius_i) + 1 / (inertia_j + mass_j * radius_j * radius_j));
}

/// c_r = 2 eta sqrt(I_r k_r), N m s. \param damping_ratio eta, 0 for no damping, about 0.3 in the source
[[nodiscard]] inline double rolling_damping(double damping_ratio, double inertia, double stiffness) {
  return 2 * damping_ratio * std::sqrt(inertia * stiffness);
}

/// epsd: adds -k_r w_rel dt to the spring, limits it to mu_r R* F_n, and adds -c_r w_rel while it is below the limit.
/// \param spring moment of the spring before this step
[[nodiscard]] inline RollingMoment rolling_epsd(const Vec3& spring, const Vec3& relative_spin, double stiffness,
                                                double damping, double limit, double time_step) {
  const Vec3 tried = spring - (stiffness * time_step) * relative_spin;
  const double squared = dot(tried, tried);
  const bool slips = squared > limit * limit;
  const Vec3 held = (slips ? limit / std::sqrt(slips ? squared : 1.0) : 1) * tried;
  return {held - (slips ? 0 : damping) * relative_spin, held};
}

}  // namespace polybed::closures
