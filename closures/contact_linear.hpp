// Normal contact as a linear spring and dashpot, Cundall and Strack (Geotechnique 29, 1979, 47).
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

namespace polybed::closures {

/// c = 2 beta sqrt(k m*), kg/s. \param beta from restitution.hpp
[[nodiscard]] inline double linear_damping(double beta, double stiffness, double mass) {
  return 2 * beta * std::sqrt(stiffness * mass);
}

/// t_c = pi sqrt(m*/k)/sqrt(1 - beta^2), s, with the tail kept; infinite for beta >= 1, where the spheres creep apart.
[[nodiscard]] inline double linear_contact_time(double stiffness, double mass, double beta) {
  return beta < 1 ? std::numbers::pi * std::sqrt(mass / stiffness) / std::sqrt((1 - beta) * (1 + beta))
                  : std::numeric_limits<double>::infinity();
}

/// k delta^2/2, J.
[[nodiscard]] inline double linear_stored_energy(double stiffness, double overlap) {
  return 0.5 * stiffness * overlap * overlap;
}

/// Default ratio of tangential to normal stiffness, 2/7: equal periods of both springs for a solid sphere on a plane, m
/// R^2/I = 5/2.
inline constexpr double linear_tangential_share = 2.0 / 7;

}  // namespace polybed::closures
