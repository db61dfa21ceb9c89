// What may be said of measured times, and of two runs that should be the same.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace polybed::multiscale {

/// Times of one and the same run, summed up.
struct Timing {
  double median = 0, deviation = 0;  ///< s; the median absolute deviation
  double quartiles = 0;              ///< s between the first and the third quartile
};

/// Quantiles are linear between the sorted values (Hyndman and Fan 1996, type 7). Throws std::invalid_argument for
/// none.
[[nodiscard]] Timing timing_of(std::span<const double> seconds);

/// Why speeds are not to be ranked: the interquartile range exceeds 10 % of the median, or the load the cores (cost.md,
/// section 7); empty if they may be.
[[nodiscard]] std::optional<std::string> too_noisy(const Timing& timing, double load, double cores);

/// Whether two runs that differ by 1e-10 part by more than a hundredth of what the signal varies by: chaotic, to be
/// judged by statistics. Series that are constant to 1e-9 of their mean are steady.
/// \param signal, twin  the same quantity at the same times
[[nodiscard]] bool is_chaotic(std::span<const double> signal, std::span<const double> twin);

}  // namespace polybed::multiscale
