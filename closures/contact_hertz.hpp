// Hertz's normal contact of elastic spheres.
#pragma once

#include <cmath>

namespace polybed::closures {

/// a = sqrt(R* delta), m: radius of the area of contact.
[[nodiscard]] inline double hertz_contact_radius(double reduced_radius, double overlap) {
  return std::sqrt(reduced_radius * overlap);
}

/// F = (4/3) E* a delta, N.
[[nodiscard]] inline double hertz_force(double reduced_modulus, double contact_radius, double overlap) {
  return 4.0 / 3 * reduced_modulus * contact_radius * overlap;
}

/// S_n = dF/d(delta) = 2 E* a, N/m.
[[nodiscard]] inline double hertz_stiffness(double reduced_modulus, double contact_radius) {
  return 2 * reduced_modulus * contact_radius;
}

/// Energy stored, (8/15) E* sqrt(R*) delta^(5/2), J.
[[nodiscard]] inline double hertz_energy(double reduced_modulus, double reduced_radius, double overlap) {
  return 8.0 / 15 * reduced_modulus * std::sqrt(reduced_radius * overlap) * overlap * overlap;
}

/// c_n = 2 sqrt(5/6) beta sqrt(S_n m*), kg/s: gives a restitution that does not depend on the speed.
[[nodiscard]] inline double hertz_dashpot(double reduced_modulus, double reduced_mass, double beta,
                                          double contact_radius) {
  return 2 * std::sqrt(5.0 / 6) * beta * std::sqrt(hertz_stiffness(reduced_modulus, contact_radius) * reduced_mass);
}

/// Greatest overlap of an elastic impact at a speed V: delta_m = (5 m* V^2/(4 K))^(2/5), K = (4/3) E* sqrt(R*), m.
[[nodiscard]] inline double hertz_impact_overlap(double reduced_modulus, double reduced_radius, double reduced_mass,
                                                 double speed) {
  return std::pow(5 * reduced_mass * speed * speed / (4 * (4.0 / 3) * reduced_modulus * std::sqrt(reduced_radius)),
                  0.4);
}

/// Duration of an elastic impact, 2.9432751843 delta_m/V, s.
[[nodiscard]] inline double hertz_impact_time(double greatest_overlap, double speed) {
  return 2.9432751843 * greatest_overlap / speed;
}

}  // namespace polybed::closures
