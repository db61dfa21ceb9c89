// The damping ratio of a dashpot that realises a coefficient of restitution, with the tensile tail kept or clipped.
#pragma once

#include <cmath>
#include <numbers>

namespace polybed::closures {

/// Least restitution that a clipped dashpot is asked for: below it the damping ratio grows without bound.
inline constexpr double least_restitution = 0.05;

/// beta = -ln e/sqrt(pi^2 + ln^2 e): exact for the linear law and for Hertz's with its tail kept.
/// \param e  restitution, in (0, 1]; below least_restitution that is used
[[nodiscard]] inline double damping_ratio_kept(double e) {
  const double ln = std::log(e > least_restitution ? e : least_restitution);
  return -ln / std::sqrt(std::numbers::pi * std::numbers::pi + ln * ln);
}

/// Restitution realised by a dashpot whose contact ends where its force would pull, for either law:
/// exp[-(beta/s) atan2(2 beta s, 2 beta^2 - 1)], s = sqrt(1 - beta^2), below critical damping;
/// exp[-(beta/s) ln((beta + s)/(beta - s))], s = sqrt(beta^2 - 1), above; exp(-2) at it.
[[nodiscard]] inline double restitution_clipped(double beta) {
  const double square = 1 - beta * beta, s = std::sqrt(std::abs(square));
  if (s < 1e-8) return std::exp(-2.0);
  if (square > 0) return std::exp(-beta / s * std::atan2(2 * beta * s, 2 * beta * beta - 1));
  return std::exp(-beta / s * std::log((beta + s) / (beta - s)));
}

/// beta with restitution_clipped(beta) = e, to round-off, by bisection: the function falls.
/// \param e  as of damping_ratio_kept
[[nodiscard]] inline double damping_ratio_clipped(double e) {
  if (e >= 1) return 0;
  const double wanted = e > least_restitution ? e : least_restitution;
  double low = 0, high = 10;
  for (int n = 0; n < 200 && high - low > 1e-16 * high; ++n) {
    const double middle = 0.5 * (low + high);
    (restitution_clipped(middle) > wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace polybed::closures
