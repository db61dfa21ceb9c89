// Kinetic theory of inelastic spheres: pressure, viscosity, dissipation and conductivity in rapid granular flow, its
// exchange of fluctuation energy with a fluid, and walls. theta = <v'^2>/3, m2/s2. Valid for collisions that a fluid
// hardly damps (shear rate times relaxation time of the slip above about 1), without enduring contacts.
//
// Starred: p* = p/(rho theta), mu* = mu/(rho D sqrt theta), Gamma* = Gamma D/(rho theta^1.5), k* = k/(rho D sqrt
// theta); functions of the solids fraction phi in [0, 1), the radial distribution at contact g0 >= 1 and the
// restitution e in [0, 1]. For a mixture, g0 is sum_k phi_k g_jk / phi.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace polybed::closures {

/// Solution of the kinetic equation: Lun, Savage, Jeffrey and Chepurniy (J. Fluid Mech. 140, 1984, 223-256), or
/// Garzo and Dufty (Phys. Rev. E 59, 1999, 5895-5911).
enum class KineticModel { lun, garzo_dufty };

/// Radial distribution at contact and its slope with the solids fraction.
struct RadialValue {
  double value, slope;
};

/// Carnahan and Starling (J. Chem. Phys. 51, 1969, 635): (1 - phi/2)/(1 - phi)^3, phi < 1. For a gas of hard spheres up
/// to freezing at 0.49; finite beyond.
[[nodiscard]] inline RadialValue radial_carnahan_starling(double phi) {
  const double per_eps = 1 / (1 - phi), per_eps3 = per_eps * per_eps * per_eps;
  return {(1 - 0.5 * phi) * per_eps3, (3 * (1 - 0.5 * phi) * per_eps - 0.5) * per_eps3};
}

/// Carnahan-Starling up to 0.49, above it Torquato (Phys. Rev. E 51, 1995, 3170): CS(0.49) (phi_c - 0.49)/(phi_c -
/// phi), phi_c = 0.64 where random spheres jam; beyond phi_c - 0.005 its tangent, so that it has no pole. Any phi.
[[nodiscard]] inline RadialValue radial_distribution_dense(double phi) {
  constexpr double freezing = 0.49, jammed = 0.64, margin = 0.005;
  if (phi <= freezing) return radial_carnahan_starling(phi);
  const double residue = radial_carnahan_starling(freezing).value * (jammed - freezing);
  const double gap = jammed - std::min(phi, jammed - margin), slope = residue / (gap * gap);
  return {residue / gap + slope * std::max(phi - (jammed - margin), 0.0), slope};
}

/// g_ij for hard spheres of several sizes (Mansoori et al., J. Chem. Phys. 54, 1971, 1523):
///   1/(1-phi) + 3 q xi/(1-phi)^2 + 2 q^2 xi^2/(1-phi)^3,  q = D_i D_j/(D_i + D_j),  xi = sum phi_k/D_k.
/// Carnahan-Starling for equal sizes. voidage = 1 - phi > 0; surface = xi, 1/m.
[[nodiscard]] inline double radial_of_pair(double voidage, double surface, double diameter_i, double diameter_j) {
  const double per_voidage = 1 / voidage;
  const double q = diameter_i * diameter_j / (diameter_i + diameter_j) * surface * per_voidage;
  return (1 + 3 * q + 2 * q * q) * per_voidage;
}

/// p* = phi [1 + 2 (1+e) phi g0].
[[nodiscard]] inline double kinetic_pressure(double phi, double g0, double e) {
  return phi * (1 + 2 * (1 + e) * phi * g0);
}

/// Contribution of species j to the collisional pressure of species i in a mixture (Enskog): h_ij in
/// p_i = phi_i rho_i theta_i (1 + sum_j h_ij),  h_ij = 4 phi_j (D_ij/D_j)^3 g_ij (1 + e_ij) m_j/(m_i + m_j),
/// D_ij = (D_i + D_j)/2. The sum over i is n_i T_i + (pi/3) n_i n_j D_ij^3 g_ij (1+e_ij)(m_j T_i + m_i T_j)/(m_i +
/// m_j). mass_ratio = m_i/m_j.
[[nodiscard]] inline double mixture_pressure_of_pair(double phi_j, double g0, double e, double diameter_i,
                                                     double diameter_j, double mass_ratio) {
  const double reach = 0.5 * (diameter_i / diameter_j + 1);
  return 4 * reach * reach * reach * (1 + e) / (1 + mass_ratio) * phi_j * g0;
}

/// c in Garzo and Dufty: fourth cumulant of the velocities, 32(1-e)(1-2e^2)/(81 - 17e + 30e^2(1-e)).
[[nodiscard]] inline double velocity_cumulant(double e) {
  return 32 * (1 - e) * (1 - 2 * e * e) / (81 - 17 * e + 30 * e * e * (1 - e));
}

/// Gamma* = (12/sqrt pi)(1 - e^2) phi^2 g0; for Garzo and Dufty times 1 + 3c/32.
[[nodiscard]] inline double kinetic_dissipation(KineticModel model, double phi, double g0, double e) {
  const double lun = 12 * std::numbers::inv_sqrtpi * (1 - e * e) * phi * phi * g0;
  return model == KineticModel::lun ? lun : lun * (1 + 3 * velocity_cumulant(e) / 32);
}

/// mu* of a dilute elastic gas, 5 sqrt(pi)/96.
constexpr double dilute_viscosity = 5 * 1.7724538509055160273 / 96;

/// mu* for Lun, eta = (1+e)/2:
///   m0/(g0 eta (2-eta)) (1 + 8/5 eta phi g0)(1 + 8/5 eta (3 eta - 2) phi g0) + 3/5 eta 256 m0 phi^2 g0/(5 pi).
[[nodiscard]] inline double viscosity_lun(double phi, double g0, double e) {
  const double eta = 0.5 * (1 + e), contact = eta * phi * g0;
  return dilute_viscosity * ((1 + 1.6 * contact) * (1 + 1.6 * (3 * eta - 2) * contact) / (g0 * eta * (2 - eta)) +
                             0.6 * 256 / (5 * std::numbers::pi) * contact * phi);
}

/// mu* for Garzo and Dufty, with z = (5/12) g0 (1-e^2)(1 + 3c/32), n = g0 [1 - (1-e)^2/4](1 - c/64):
///   k = [1 - (2/5)(1+e)(1-3e) phi g0]/(n - z/2),
///   mu* = m0 {k [1 + (4/5) phi g0 (1+e)] + (3/5)(128/(5 pi)) phi^2 g0 (1+e)(1 - c/32)}.
[[nodiscard]] inline double viscosity_garzo_dufty(double phi, double g0, double e) {
  const double c = velocity_cumulant(e);
  const double z = 5.0 / 12 * g0 * (1 - e * e) * (1 + 3 * c / 32);
  const double n = g0 * (1 - 0.25 * (1 - e) * (1 - e)) * (1 - c / 64);
  const double k = (1 - 0.4 * (1 + e) * (1 - 3 * e) * phi * g0) / (n - 0.5 * z);
  return dilute_viscosity * (k * (1 + 0.8 * phi * g0 * (1 + e)) +
                             0.6 * 128 / (5 * std::numbers::pi) * phi * phi * g0 * (1 + e) * (1 - c / 32));
}

[[nodiscard]] inline double kinetic_viscosity(KineticModel model, double phi, double g0, double e) {
  return model == KineticModel::lun ? viscosity_lun(phi, g0, e) : viscosity_garzo_dufty(phi, g0, e);
}

/// k* for Lun, eta = (1+e)/2: 75 sqrt(pi)/[48 eta (41-33 eta) g0] {[1 + (12/5) eta phi g0]
///   [1 + (12/5) eta^2 (4 eta - 3) phi g0] + 64/(25 pi) (41-33 eta)(eta phi g0)^2}; flux of energy -k grad theta.
[[nodiscard]] inline double kinetic_conductivity(double phi, double g0, double e) {
  const double eta = 0.5 * (1 + e), contact = eta * phi * g0, slow = 41 - 33 * eta;
  return 75 / (48 * std::numbers::inv_sqrtpi * eta * slow * g0) *
         ((1 + 2.4 * contact) * (1 + 2.4 * eta * (4 * eta - 3) * contact) +
          64 / (25 * std::numbers::pi) * slow * contact * contact);
}

/// Energy loss of fluctuations to the fluid's drag, W/m3 per unit of solids fraction: 3 b theta, b = beta_j/phi_j.
[[nodiscard]] inline double fluctuation_drag_sink(double exchange, double theta) { return 3 * exchange * theta; }

/// Energy gain of fluctuations from slip, Koch and Sangani (J. Fluid Mech. 400, 1999, 229-263), W/m3 per unit of solids
/// fraction, times sqrt theta: 81 phi mu^2 w^2/(g0 D^3 rho sqrt pi). Its source divides the result by sqrt theta and
/// gives it for high Stokes numbers.
/// \param phi        solids fraction, all species  \param viscosity  of the fluid, Pa s
/// \param slip       w = |U_f - U_j|, m/s
[[nodiscard]] inline double slip_production(double phi, double g0, double viscosity, double slip, double diameter,
                                            double density) {
  return 81 * phi * viscosity * viscosity * slip * slip * std::numbers::inv_sqrtpi /
         (g0 * diameter * diameter * diameter * density);
}

/// x^power for x > 0 and a power of 1/3 or 1/4, at most 6 % above it and not below: multiplies the binary exponent by
/// the power, with the mantissa as an approximate logarithm. No branch, only + * and shifts.
[[nodiscard]] inline double root_bound(double x, double power) {
  constexpr double one = 0x3ff00000, shift = 0x1p52;  // the upper half of 1.0; a double whose lower bits count units
  const auto upper = std::bit_cast<std::uint64_t>(x) >> 32;
  const double exponent = std::bit_cast<double>(upper | std::bit_cast<std::uint64_t>(shift)) - shift;
  // Add one unit of the upper half, to compensate for the truncation of x.
  const double scaled = exponent * power + (one * (1 - power) + 1);
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(scaled + shift) << 32);
}

/// Root s = sqrt theta > 0 of a s^4 + b s^3 = p s^2 + c, a > 0, p and c >= 0, any b: collisions and drag against shear
/// and slip. One sign change, so one root (Descartes); Newton from above, where the curve is convex. 0 if p = c = 0 and
/// b >= 0. No branch: a loop over it is vectorised.
[[nodiscard]] inline double balanced_speed(double a, double b, double p, double c) {
  const double root = std::sqrt(b * b + 4 * a * p);
  const double without_slip = (b > 0 ? 2 * p : root - b) / (b > 0 ? root + b : 2 * a);
  // f(s) = a s^4 + b s^3 - p s^2 - c is above 0 at the sum of the root without c and (c/a)^(1/4) or, if b > 0,
  // (c/b)^(1/3). From the smaller, seven steps reach round-off for all a, b, p and c.
  const double alone = root_bound(c / a, 0.25), dragged = root_bound(c / (b > 0 ? b : 1.0), 1.0 / 3);
  double s = without_slip + (b > 0 && dragged < alone ? dragged : alone);
#pragma GCC unroll 7
  for (int n = 0; n < 7; ++n) s -= (((a * s + b) * s - p) * s * s - c) / (((4 * a * s + 3 * b) * s - 2 * p) * s);
  constexpr double least_slip = 1e-200;  // the powers of s would underflow below it
  return c > least_slip ? s : without_slip;
}

/// Decrease of that root s with b, -ds/db = s^3/(4 a s^3 + 3 b s^2 - 2 p s), with the balance inserted: s^4/(a s^4 + p
/// s^2 + 3 c). 0 if s is 0.
[[nodiscard]] inline double fall_of_balanced_speed(double a, double p, double c, double s) {
  const double square = s * s, least = std::numeric_limits<double>::min();
  return square * square / (a * square * square + p * square + 3 * c + least);
}

/// Wall friction on slipping solids per unit speed, Pa s/m, Johnson and Jackson (J. Fluid Mech.
/// 176, 1987, 67-93): pi sqrt(3 theta) s rho phi g0/(6 phi_max), s in [0, 1] the specularity.
[[nodiscard]] inline double wall_collisions(double theta, double specularity, double density, double phi, double g0,
                                            double max_packing) {
  return std::numbers::pi * std::sqrt(3 * std::max(theta, 0.0)) * specularity * density * phi * g0 / (6 * max_packing);
}

/// Friction of a wall on solids pressed against it, Pa s/m: p_f tan(delta_w)/|U_t|.
/// \param rounding  of |U_t| at 0, m/s, above 0
[[nodiscard]] inline double wall_friction(double pressure, double tangent, double speed, double rounding) {
  return pressure * tangent / std::sqrt(speed * speed + rounding * rounding);
}

/// Fluctuation energy from a wall to the solids, W/m2, from the same source:
///   pi sqrt(3 theta) rho phi g0/phi_max [s |U_t|^2/6 - (1 - e_w^2) theta/4].
[[nodiscard]] inline double wall_energy(double theta, double specularity, double wall_restitution, double speed,
                                        double density, double phi, double g0, double max_packing) {
  const double hits = std::numbers::pi * std::sqrt(3 * std::max(theta, 0.0)) * density * phi * g0 / max_packing;
  return hits * (specularity * speed * speed / 6 - 0.25 * (1 - wall_restitution * wall_restitution) * theta);
}

}  // namespace polybed::closures
