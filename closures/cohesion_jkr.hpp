// Adhesion of soft large spheres, Johnson, Kendall and Roberts (Proc. R. Soc. A 324, 1971, 301):
//   delta = a^2/R* - sqrt(2 pi W a/E*),  F = 4 E* a^3/(3 R*) - sqrt(8 pi W E* a^3),
// on the stable branch, which includes a neck down to delta = -delta_s. In u = sqrt(a/a_s), a_s^3 = pi W R*^2/(8 E*):
//   delta/delta_s = (u^4 - 4 u)/3,  delta_s = 3 a_s^2/R*,  F = pi W R* (u^6/6 - u^3),  u >= 1.
// The force replaces Hertz', along n on i, positive in repulsion. A contact begins at overlap 0 and ends when the gap
// exceeds delta_s: its existence is part of the state.
#pragma once

#include <cmath>
#include <numbers>

namespace polybed::closures {

/// Constants of a pair: pi W R* (N), a_s and delta_s (m), where the neck breaks.
struct JkrScales {
  double force, contact_radius, gap;
};

/// For set-up. W > 0, else the scales are undefined: use Hertz without adhesion.
[[nodiscard]] inline JkrScales jkr_scales(double work_of_adhesion, double youngs_modulus, double reduced_radius) {
  const double force = std::numbers::pi * work_of_adhesion * reduced_radius;
  const double a = std::cbrt(force * reduced_radius / (8 * youngs_modulus));
  return {force, a, 3 * a * a / reduced_radius};
}

/// u for an overlap in units of delta_s; below -1, with a broken neck, its value at -1. Newton on the root of u^4 - 4 u
/// + 3 = (u - 1)^2 (u^2 + 2 u + 3), which has no double root; four steps from below reach 1e-14.
[[nodiscard]] inline double jkr_size(double overlap_over_gap) {
  const double above = 3 * (overlap_over_gap + 1), square = above > 0 ? above : 0, q = std::sqrt(square);
  double u = 1 + 0.5 * (std::sqrt(6 + 4 * q) - 2.4494897427831780982);
  for (int n = 0; n < 4; ++n) {
    const double p = u * u + 2 * u + 3;
    u -= 0.5 * ((u - 1) * p - q * std::sqrt(p)) / (u * u + u + 1);
  }
  return u;
}

/// F, N. \param overlap negative for a neck
[[nodiscard]] inline double jkr_force(const JkrScales& scales, double overlap) {
  const double u = jkr_size(overlap / scales.gap), cube = u * u * u;
  return scales.force * cube * (cube / 6 - 1);
}

/// Integral of F over delta from the neck's rupture, J: (4/3) pi W R* delta_s [u^10/60 - u^7/6 + u^4/4 - 1/10]. At
/// overlap 0 it is -1.4033 pi W R* delta_s = -7.09 (W^5 R*^4/E*^2)^(1/3), the energy to separate two touching surfaces
/// (Thornton and Ning, Powder Technol. 99, 1998, 154).
[[nodiscard]] inline double jkr_energy(const JkrScales& scales, double overlap) {
  const double u = jkr_size(overlap / scales.gap), cube = u * u * u, fourth = u * cube;
  return 4.0 / 3 * scales.force * scales.gap * (fourth * (cube * (cube / 60 - 1.0 / 6) + 0.25) - 0.1);
}

}  // namespace polybed::closures
