// Damping ratio of a contact from the required restitution. For set-up: uses logarithms.
//
// A contact with spring F = K delta^p and dashpot c = 2 zeta sqrt(S m*), S = dF/d(delta), loses the same share of its
// speed at every speed for p = 1 (linear, zeta = beta) and p = 3/2 (Hertz, zeta = sqrt(5/6) beta), and both have the
// same e(beta). Near separation the dashpot exceeds the spring: "kept" allows attraction, "clipped" ends the force.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace polybed::closures {

/// beta with the attractive tail kept: -ln e/sqrt(pi^2 + ln^2 e) (Tsuji, Tanaka and Ishida, Powder Technol. 71, 1992,
/// 239; Antypov and Elliott, EPL 94, 2011, 50004). e in (0, 1]; 0 gives its limit 1, above 1 gives 0.
[[nodiscard]] inline double damping_ratio_kept(double restitution) {
  if (!(restitution > 0)) return 1;
  const double log_e = std::log(std::min(restitution, 1.0));
  return -log_e / std::sqrt(std::numbers::pi * std::numbers::pi + log_e * log_e);
}

/// Restitution with the tail clipped (Schwager and Poeschel, Granular Matter 9, 2007, 465):
///   exp[-(beta/s) atan2(2 beta s, 2 beta^2 - 1)], s = sqrt(1 - beta^2), for beta < 1,
///   exp[-(beta/s) ln((beta + s)/(beta - s))], s = sqrt(beta^2 - 1), above; exp(-2) at 1. beta >= 0.
/// Written with the half angle, which avoids cancellation on both sides of 1.
[[nodiscard]] inline double restitution_clipped(double beta) {
  const double s = std::sqrt(std::abs((1 - beta) * (1 + beta)));
  if (s == 0) return std::exp(-2.0);
  const double half = beta < 1 ? std::atan2(s, beta) : std::asinh(s);
  return std::exp(-2 * beta * half / s);
}

/// Least restitution for which the clipped law is solved; below it the damping ratio is constant.
inline constexpr double least_restitution_clipped = 0.05;

/// Solves restitution_clipped(beta) = e by bisection to the last bit. e in [0.05, 1]; below uses 0.05 (the caller
/// reports it), above 1 gives 0.
[[nodiscard]] inline double damping_ratio_clipped(double restitution) {
  if (!(restitution < 1)) return 0;
  const double e = std::max(restitution, least_restitution_clipped);
  double low = 0, high = 4;  // e_clip(4) = 0.014, below the least
  for (int n = 0; n < 200; ++n) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (restitution_clipped(middle) > e ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace polybed::closures
