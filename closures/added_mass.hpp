// Added mass: fluid that a sphere drags along when it accelerates relative to it.
//
// Force C_m rho_f V (Du_f/Dt - dv/dt). Its dv/dt must be on the left, as inertia of the particle: with the value of the
// last step, errors grow by C_m rho_f/rho_p per step for any step length, and without bound if that exceeds 1.
#pragma once

#include <algorithm>
#include <numbers>

namespace polybed::closures {

/// C_m for one sphere in an unbounded fluid without circulation (Lamb, Hydrodynamics, 1932, section 92).
inline constexpr double added_mass_of_one = 0.5;

/// Largest solids fraction for the swarm's coefficient: 1 minus the least voidage in the drag closures.
inline constexpr double added_mass_largest_fraction = 0.74;

/// C_m = (1 + 2 phi)/(2 (1 - phi)) in a swarm (Zuber, Chem. Eng. Sci. 19, 1964, 897: a sphere in a concentric shell).
/// phi is clamped to 0 to 0.74, so that C_m is 0.5 to 4.77 and finite where phi reaches 1.
[[nodiscard]] inline double added_mass_zuber(double solids_fraction) {
  const double phi = std::clamp(solids_fraction, 0.0, added_mass_largest_fraction);
  return (1 + 2 * phi) / (2 * (1 - phi));
}

/// C_m rho_f V, kg, for a sphere: added to its mass, and times Du_f/Dt the fluid's part of the force, N.
[[nodiscard]] inline double added_mass_inertia(double coefficient, double fluid_density, double diameter) {
  return coefficient * fluid_density * (std::numbers::pi / 6) * diameter * diameter * diameter;
}

}  // namespace polybed::closures
