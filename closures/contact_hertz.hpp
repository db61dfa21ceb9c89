// Normal contact of elastic spheres, Hertz 1882, with the dashpot of Tsuji, Tanaka and Ishida (Powder Technol. 71,
// 1992, 239). E* and R* as in contact_pair.hpp; overlap delta >= 0, m.
#pragma once

#include <cmath>

#include "closures/contact_pair.hpp"

namespace polybed::closures {

/// K = (4/3) E* sqrt(R*), N/m^1.5, of F = K delta^1.5.
[[nodiscard]] inline double hertz_coefficient(double youngs_modulus, double radius) {
  return 4.0 / 3 * youngs_modulus * std::sqrt(radius);
}

/// a = sqrt(R* delta), m: radius of the contact.
[[nodiscard]] inline double contact_radius(double radius, double overlap) { return std::sqrt(radius * overlap); }

/// S_n = dF/d(delta) = 2 E* a, N/m.
[[nodiscard]] inline double hertz_stiffness(double youngs_modulus, double contact_radius) {
  return 2 * youngs_modulus * contact_radius;
}

/// sqrt(5/6): damping ratio of the tangent spring over beta.
inline constexpr double hertz_damping_share = 0.91287092917527685576;

/// c_n = 2 sqrt(5/6) beta sqrt(S_n m*), kg/s. \param beta from restitution.hpp  \param mass m*
[[nodiscard]] inline double hertz_damping(double beta, double stiffness, double mass) {
  return 2 * hertz_damping_share * beta * std::sqrt(stiffness * mass);
}

/// (4/3) E* a delta and -c_n v_n.
/// \param contact_radius   a of this overlap  \param damping c_n  \param normal_velocity v_n, negative on approach
[[nodiscard]] inline NormalForce hertz_force(double youngs_modulus, double contact_radius, double overlap,
                                             double damping, double normal_velocity) {
  return {4.0 / 3 * youngs_modulus * contact_radius * overlap, -damping * normal_velocity};
}

/// (2/5) K delta^2.5, J.
[[nodiscard]] inline double hertz_stored_energy(double coefficient, double overlap) {
  return 0.4 * coefficient * overlap * overlap * std::sqrt(overlap);
}

/// delta_m = (5 m* V^2/(4 K))^(2/5), m, in an elastic impact at speed V. For set-up.
[[nodiscard]] inline double hertz_greatest_overlap(double coefficient, double mass, double speed) {
  return std::pow(1.25 * mass * speed * speed / coefficient, 0.4);
}

/// F_m = K delta_m^1.5, N.
[[nodiscard]] inline double hertz_greatest_force(double coefficient, double greatest_overlap) {
  return coefficient * greatest_overlap * std::sqrt(greatest_overlap);
}

/// t_c over delta_m/V: 2 int_0^1 dx/sqrt(1 - x^2.5) = (4/5) sqrt(pi) Gamma(2/5)/Gamma(9/10).
inline constexpr double hertz_time_factor = 2.9432751843;

/// t_c = 2.9432751843 delta_m/V, s, for an elastic impact. For set-up.
[[nodiscard]] inline double hertz_contact_time(double greatest_overlap, double speed) {
  return hertz_time_factor * greatest_overlap / speed;
}

}  // namespace polybed::closures
