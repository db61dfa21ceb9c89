// Means over time of a run that fluctuates, with their uncertainty.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace polybed::hard {

/// Half-widths of intervals are those of 95 %.
constexpr double confidence = 0.95;

struct TimeMean {
  double mean = 0;
  std::optional<double> error;  ///< half-width of the interval; empty: too few rows to tell
  double correlation = 1;       ///< integrated autocorrelation time, rows
};

/// Two-sided 95 % quantile of Student's distribution; tabulated for 3 to 10 and 19 degrees of freedom, between and
/// beyond them that of the next smaller entry, which is wider. Throws std::invalid_argument below 3.
[[nodiscard]] double student_quantile(std::size_t degrees);

/// 1 + 2 sum of the autocorrelation, in rows, summed up to the first lag that is at least five times half of the sum
/// (Sokal 1997, "Monte Carlo methods in statistical mechanics", section 3, c = 5); at least 1. So many rows count as
/// one that is independent. Biased low where the series is not many times longer.
[[nodiscard]] double autocorrelation_time(std::span<const double> values);

/// Mean of a series in equal steps of time. The interval is the wider of two: batch means (20 batches from 40 rows on,
/// 10 from 20 rows on), and the variance of the rows with the autocorrelation time. Empty without rows, or if one of
/// them is not a number.
[[nodiscard]] std::optional<TimeMean> time_mean(std::span<const double> values);

/// Rows to leave out at the beginning by the marginal standard error rule (White 1997, Simulation 69, 323): the d that
/// makes sum (x - mean)^2 / (n - d)^2 over the rows from d on least; at most half of the rows. 0 if a row is no number.
[[nodiscard]] std::size_t rows_to_drop(std::span<const double> values);

/// What a function of several rows varies by.
struct Jackknife {
  double variance = 0;      ///< of its value for all rows
  std::size_t degrees = 0;  ///< of freedom
};

/// Delete-a-group jackknife (Efron and Tibshirani 1993, chapter 11) of at most ten groups of successive rows; empty
/// for less than four rows or where a part has no value. Meant for smooth functions: rough for one that jumps.
/// \param value  of the rows that are true
[[nodiscard]] std::optional<Jackknife> jackknife(
    std::size_t rows, const std::function<std::optional<double>(const std::vector<bool>&)>& value);

}  // namespace polybed::hard
