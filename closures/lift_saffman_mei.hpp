// Lift on a sphere in a sheared fluid: towards the faster fluid if the sphere lags, away from it if the sphere leads.
#pragma once

#include <algorithm>
#include <cmath>

#include "closures/elementary.hpp"
#include "closures/vec3.hpp"

namespace polybed::closures {

/// Least shear a in the fit of the share.
inline constexpr double lift_least_shear_mei = 0.005;

/// Share of Saffman's lift at finite Re_p (Mei, Int. J. Multiphase Flow 18, 1992, 145, a fit to Dandy and Dwyer, J.
/// Fluid Mech. 216, 1990, 381; Re_p 0.1-100): 1 below Re_p 0.1, else
///   (1 - 0.3314 sqrt a) exp(-Re_p/10) + 0.3314 sqrt a  to Re_p 40,  0.0524 sqrt(a Re_p)  above, at most 1.
/// The fit jumps by (1 - 0.3314 sqrt a) e^-4 < 0.018 at Re_p 40, and by less than 0.01 at 0.1.
/// \param reynolds Re_p = rho_f w d/mu, w the speed of slip  \param shear a = d |omega|/(2 w), held in 0.005-0.4
[[nodiscard]] inline double lift_share_mei(double reynolds, double shear) {
  // Selects instead of branches, so that a loop over cells is vectorised.
  const double a = std::clamp(shear, lift_least_shear_mei, 0.4), floor = 0.3314 * std::sqrt(a);
  const double low = (1 - floor) * plain_exp(-0.1 * std::min(reynolds, 40.0)) + floor;
  const double high = std::min(0.0524 * std::sqrt(a * reynolds), 1.0);
  return reynolds < 0.1 ? 1.0 : reynolds <= 40 ? low : high;
}

/// 1.615 d^2 sqrt(mu rho_f/|omega|) (u_f - v) x omega M, N (Saffman, J. Fluid Mech. 22, 1965, 385, and 31, 1968, 624; M
/// as above). Zero without slip and without vorticity; finite everywhere.
/// \param slip u_f - v, m/s  \param vorticity omega = curl u_f, 1/s
/// \param least_shear  a below which the force is linear in omega; the root's slope would be infinite at 0
[[nodiscard]] inline Vec3 lift_saffman_mei(const Vec3& slip, const Vec3& vorticity, double diameter,
                                           double fluid_density, double viscosity, double least_shear = 0) {
  constexpr double least = 1e-150;  // avoids 0/0; its square is still representable
  const double speed = std::sqrt(dot(slip, slip)), spin = std::max(std::sqrt(dot(vorticity, vorticity)), least);
  const double reynolds = fluid_density * speed * diameter / viscosity;
  const double share = lift_share_mei(reynolds, 0.5 * diameter * spin / std::max(speed, least));
  const double held = std::max(spin, 2 * least_shear * speed / diameter);
  return 1.615 * diameter * diameter * std::sqrt(viscosity * fluid_density / held) * share * cross(slip, vorticity);
}

}  // namespace polybed::closures
