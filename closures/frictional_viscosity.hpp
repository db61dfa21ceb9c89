// Shear viscosity of solids in enduring contact: the frictional stress is a share of the pressure, at any rate.
#pragma once

#include <algorithm>
#include <cmath>

namespace polybed::closures {

/// |gamma| = sqrt(2 D':D' + gamma_0^2), 1/s, D' the deviator of the rate of strain. gamma_0 > 0 keeps the viscosity
/// finite at rest, where solids then creep instead of standing.
/// \param strain  2 D':D', 1/s2: gamma^2 in simple shear
[[nodiscard]] inline double shear_rate(double strain, double least) { return std::sqrt(strain + least * least); }

/// Schaeffer (J. Differ. Equations 66, 1987, 19-50): mu_f = p_f sin(delta)/|gamma|, Pa s, at most `cap`.
/// \param pressure  p_f, Pa; below 0 counts as 0  \param sine  sin(delta), delta the angle of internal friction
/// \param rate      |gamma|, 1/s, > 0
[[nodiscard]] inline double viscosity_schaeffer(double pressure, double sine, double rate, double cap) {
  return std::min(std::max(pressure, 0.0) * sine / rate, cap);
}

/// mu(I) for dry grains, Jop, Forterre and Pouliquen (Nature 441, 2006, 727-730): mu_1 + (mu_2 - mu_1)/(1 + I_0/I),
/// with I = D |gamma|/sqrt(p/rho). Glass beads: mu_1 = tan 20.9 deg, mu_2 = tan 32.76 deg, I_0 = 0.279.
struct InertialFriction {
  double slow = 0.38, fast = 0.64, crossing = 0.28;  ///< mu_1, mu_2, I_0

  /// mu(I) at an inertial number >= 0.
  [[nodiscard]] double operator()(double inertial_number) const {
    return slow + (fast - slow) * inertial_number / (inertial_number + crossing);
  }
};

/// mu_s = mu(I) p/|gamma|, Pa s, at most `cap`; 0 without pressure.
/// \param pressure  p, Pa  \param rate  |gamma|, 1/s, > 0  \param diameter  m  \param density  of the grains, kg/m3
[[nodiscard]] inline double viscosity_mu_i(const InertialFriction& friction, double pressure, double rate,
                                           double diameter, double density, double cap) {
  if (!(pressure > 0)) return 0;
  const double inertial_number = diameter * rate / std::sqrt(pressure / density);
  return std::min(friction(inertial_number) * pressure / rate, cap);
}

}  // namespace polybed::closures
