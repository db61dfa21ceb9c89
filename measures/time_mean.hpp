// Time means of a fluctuating run, with the half-widths of their 95 % intervals: one definition for cards, comparisons
// and studies.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "measures/table.hpp"

namespace polybed::measures {

constexpr double window_share = 0.25;  ///< of a run, for means and drifts: the last quarter

struct TimeMean {
  double mean = 0;
  Value interval = {};     ///< half-width; empty: too few rows
  double correlation = 1;  ///< integrated autocorrelation time, rows
};

/// Two-sided 95 % quantile of Student's distribution, tabulated for 3 to 10 and 19 degrees of freedom. Other degrees
/// use the next smaller entry, which is wider. Throws std::invalid_argument below 3.
[[nodiscard]] double student_quantile(std::size_t degrees);

/// Computed about the first value, so that the mean of equal numbers is exact. \param values  not empty
[[nodiscard]] double mean_of(std::span<const double> values);

/// Root of the mean square about the mean.
[[nodiscard]] double deviation_of(std::span<const double> values);

/// 1 + 2 sum of the autocorrelation, in rows, up to the first lag that is at least five times half of the sum (Sokal
/// 1997, "Monte Carlo methods in statistical mechanics", section 3, c = 5); at least 1. This many rows count as one
/// independent row. Biased low unless the series is many times longer.
[[nodiscard]] double autocorrelation_time(std::span<const double> values);

/// Mean of a series with equal time steps. The interval is the wider of two: batch means (20 batches from 40 rows on,
/// 10 from 20 rows on), and the variance of the rows with the autocorrelation time. Empty without rows, or if one is
/// not finite.
[[nodiscard]] std::optional<TimeMean> time_mean(std::span<const double> values);

/// Half-width of the interval of the mean of independent values; empty for fewer than four.
[[nodiscard]] Value interval_of_repeats(std::span<const double> values);

/// Rows to leave out at the beginning by the marginal standard error rule (White 1997, Simulation 69, 323): the d that
/// minimises sum (x - mean)^2 / (n - d)^2 over the rows from d on; at most half of the rows. 0 if a row is not finite.
[[nodiscard]] std::size_t rows_to_drop(std::span<const double> values);

/// Successive rows, from begin up to before end.
struct Rows {
  std::size_t begin = 0, end = 0;
  [[nodiscard]] std::size_t count() const { return end - begin; }
  [[nodiscard]] std::span<const double> of(std::span<const double> all) const { return all.subspan(begin, count()); }
};

/// At most ten groups of successive rows, to be left out in turn; none with fewer than four rows.
[[nodiscard]] std::vector<Rows> groups_of(std::size_t rows);
/// The values without the rows of a group.
[[nodiscard]] std::vector<double> without(std::span<const double> values, const Rows& group);

/// Jackknife estimate of the spread of a function of several rows.
struct Jackknife {
  double deviation = 0;     ///< of its value for all rows
  std::size_t degrees = 0;  ///< of freedom
  [[nodiscard]] double interval() const { return student_quantile(degrees) * deviation; }
};

/// Delete-a-group jackknife (Efron and Tibshirani 1993, chapter 11). Empty for fewer than four groups, or if one has no
/// value. Rough for a function with jumps. \param values  of the function without each group in turn
[[nodiscard]] std::optional<Jackknife> jackknife(std::span<const Value> values);

/// Half-width of a function's interval, from its values without each of the groups.
[[nodiscard]] Value jackknife_interval(std::span<const Value> values);

}  // namespace polybed::measures
