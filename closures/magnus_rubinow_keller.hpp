// Side force and torque of the fluid on a spinning sphere (Rubinow and Keller, J. Fluid Mech. 11, 1961, 447).
//
// Omega is the sphere's spin and omega = curl u_f, both right-handed. A sphere that rotates with the fluid has Omega =
// omega/2 and feels neither. A ball that flies along x with backspin, its top moving backwards, has Omega along +z if y
// is up, and is lifted.
#pragma once

#include <cmath>
#include <numbers>

#include "closures/vec3.hpp"

namespace polybed::closures {

/// Omega - omega/2, 1/s.
[[nodiscard]] inline Vec3 spin_relative_to_fluid(const Vec3& spin, const Vec3& vorticity) {
  return spin - 0.5 * vorticity;
}

/// (pi/8) rho_f d^3 (Omega - omega/2) x (v - u_f), N, exact for Re_p -> 0; times 0.45 for Re_p > 1, the measured limit
/// at d |Omega| = w (Oesterle and Bui Dinh, Exp. Fluids 25, 1998, 16; Re_p 10-140). A rough factor that jumps at 1:
/// results that depend on it are uncertain by a factor of 2.
/// \param slip u_f - v, m/s, as in the other forces  \param relative_spin Omega - omega/2, 1/s
[[nodiscard]] inline Vec3 magnus_rubinow_keller(const Vec3& slip, const Vec3& relative_spin, double diameter,
                                                double fluid_density, double viscosity) {
  const double reynolds = fluid_density * std::sqrt(dot(slip, slip)) * diameter / viscosity;
  const double share = reynolds > 1 ? 0.45 : 1;
  const double factor = share * (std::numbers::pi / 8) * fluid_density * diameter * diameter * diameter;
  return factor * cross(slip, relative_spin);  // = relative_spin x (v - u_f)
}

/// pi mu d^3, N m s: the fluid's torque is minus it times Omega - omega/2. Valid to rho_f d^2 |Omega - omega/2|/mu =
/// 32; above, the torque is larger (Dennis, Singh and Ingham, J. Fluid Mech. 101, 1980, 257). A rate, for steps that
/// are implicit in the spin.
[[nodiscard]] inline double spin_resistance(double viscosity, double diameter) {
  return std::numbers::pi * viscosity * diameter * diameter * diameter;
}

}  // namespace polybed::closures
