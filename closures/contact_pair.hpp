// Properties of a contact between two bodies: reduced radius, mass and moduli, lever arms, and the normal force that
// every contact law returns. n points from j to i; the normal velocity v_n is negative on approach. A wall is a body
// with infinite radius and mass. All SI.
#pragma once

#include <cmath>

namespace polybed::closures {

/// Young's modulus E, Pa, > 0 (infinite: rigid), and Poisson ratio nu in (-1, 0.5].
struct Elastic {
  double youngs_modulus, poisson_ratio;
};

/// Force along n on i, N, positive in repulsion: the spring, and the dashpot, which is -c v_n.
struct NormalForce {
  double elastic, dashpot;
};

/// R* = R_i R_j/(R_i + R_j), m; infinity for a wall.
[[nodiscard]] inline double reduced_radius(double radius_i, double radius_j) {
  return 1 / (1 / radius_i + 1 / radius_j);
}

/// R*, m, for a sphere at a round wall: 1/R* = sqrt((1/R_i) (1/R_i - k)), the geometric mean of the two relative
/// curvatures; the one along the wall is 1/R_i (Johnson, Contact Mechanics, 1985, section 4.2). The contact is
/// approximated by a circle; the exact ellipse's force is higher by 0.1 % at k R_i = 0.2, by 1 % at 0.5 and at -1.
/// \param radius     R_i, m
/// \param curvature  k, 1/m, below 1/R_i: 1/R inside a cylinder of radius R, -1/R outside, 0 for a flat wall
[[nodiscard]] inline double reduced_radius_at_wall(double radius, double curvature) {
  return radius / std::sqrt(1 - radius * curvature);
}

/// m* = m_i m_j/(m_i + m_j), kg; infinity for a wall.
[[nodiscard]] inline double reduced_mass(double mass_i, double mass_j) { return 1 / (1 / mass_i + 1 / mass_j); }

/// Mass, kg, whose energy one contact absorbs when the heavier of two spheres hits the other, which its neighbours
/// support: the heavier's mass, divided by the number of spheres that it covers, (R_heavier/R_other)^2, if it is the
/// larger. Our estimate, for set-up; two free spheres have the energy of m*, which is less.
[[nodiscard]] inline double mass_on_a_contact(double mass_i, double radius_i, double mass_j, double radius_j) {
  const bool i_is_heavier = mass_i >= mass_j;
  const double ratio = i_is_heavier ? radius_i / radius_j : radius_j / radius_i;
  return (i_is_heavier ? mass_i : mass_j) / (ratio > 1 ? ratio * ratio : 1);
}

/// (1 + e) m_i/(m_i + m_j): speed of j, initially at rest, over the speed of i after a central impact; restitution e.
[[nodiscard]] inline double speed_passed_on(double mass_i, double mass_j, double restitution) {
  return (1 + restitution) * mass_i / (mass_i + mass_j);
}

/// 1/E* = sum (1 - nu^2)/E (Hertz 1882; Johnson, Contact Mechanics, 1985, eq. 4.1).
[[nodiscard]] inline double reduced_youngs_modulus(const Elastic& a, const Elastic& b) {
  return 1 / ((1 - a.poisson_ratio * a.poisson_ratio) / a.youngs_modulus +
              (1 - b.poisson_ratio * b.poisson_ratio) / b.youngs_modulus);
}

/// G = E/(2 (1 + nu)), Pa.
[[nodiscard]] inline double shear_modulus(const Elastic& body) {
  return body.youngs_modulus / (2 * (1 + body.poisson_ratio));
}

/// 1/G* = sum (2 - nu)/G (Mindlin, J. Appl. Mech. 16, 1949, 259).
[[nodiscard]] inline double reduced_shear_modulus(const Elastic& a, const Elastic& b) {
  return 1 / ((2 - a.poisson_ratio) / shear_modulus(a) + (2 - b.poisson_ratio) / shear_modulus(b));
}

/// I = (2/5) m R^2, solid sphere, kg m2.
[[nodiscard]] inline double moment_of_inertia(double mass, double radius) { return 0.4 * mass * radius * radius; }

/// Spring plus dashpot; the dashpot can attract near separation.
[[nodiscard]] inline double normal_kept(const NormalForce& force) { return force.elastic + force.dashpot; }

}  // namespace polybed::closures
