// Linear spring and dashpot in contact.
#pragma once

#include <cmath>
#include <numbers>

namespace polybed::closures {

/// c = 2 beta sqrt(k m*), kg/s.
[[nodiscard]] inline double linear_dashpot(double stiffness, double reduced_mass, double beta) {
  return 2 * beta * std::sqrt(stiffness * reduced_mass);
}

/// t_c = pi sqrt(m*/k)/sqrt(1 - beta^2), s, with the tail kept; beta below 1.
[[nodiscard]] inline double linear_contact_time(double stiffness, double reduced_mass, double beta) {
  return std::numbers::pi * std::sqrt(reduced_mass / stiffness) / std::sqrt(1 - beta * beta);
}

}  // namespace polybed::closures
