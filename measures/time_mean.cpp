#include "measures/time_mean.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace polybed::measures {

namespace {

double squares_of(std::span<const double> values) {
  const double mean = mean_of(values);
  double sum = 0;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return sum;
}

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// Half-width by batch means. Rows at the beginning that do not fill a batch are left out.
Value batch_interval(std::span<const double> values) {
  const std::size_t batches = values.size() >= 40 ? 20 : 10, length = values.size() / batches;
  if (length < 2) return {};
  const std::span<const double> used = values.last(batches * length);
  std::vector<double> means;
  for (std::size_t b = 0; b < batches; ++b) means.push_back(mean_of(used.subspan(b * length, length)));
  return interval_of_repeats(means);
}

}  // namespace

double student_quantile(std::size_t degrees) {
  constexpr std::array<std::pair<std::size_t, double>, 9> table{
      {{3, 3.182}, {4, 2.776}, {5, 2.571}, {6, 2.447}, {7, 2.365}, {8, 2.306}, {9, 2.262}, {10, 2.228}, {19, 2.093}}};
  if (degrees < table.front().first) throw std::invalid_argument("fewer than 3 degrees of freedom");
  double quantile = table.front().second;
  for (const auto& [from, value] : table)
    if (degrees >= from) quantile = value;
  return quantile;
}

double mean_of(std::span<const double> values) {
  double sum = 0;
  for (const double v : values) sum += v - values.front();
  return values.front() + sum / double(values.size());
}

double deviation_of(std::span<const double> values) { return std::sqrt(squares_of(values) / double(values.size())); }

double autocorrelation_time(std::span<const double> values) {
  if (values.size() < 2) return 1;
  std::vector<double> centred(values.begin(), values.end());
  const double mean = mean_of(values), square = squares_of(values);
  if (!(square > 0)) return 1;
  for (double& v : centred) v -= mean;
  double sum = 1;
  for (std::size_t lag = 1; lag < centred.size(); ++lag) {
    const auto later = centred.begin() + std::ptrdiff_t(lag);
    sum += 2 * std::transform_reduce(later, centred.end(), centred.begin(), 0.0) / square;
    if (double(lag) >= 2.5 * sum) break;
  }
  return std::max(sum, 1.0);
}

std::optional<TimeMean> time_mean(std::span<const double> values) {
  if (values.empty() || !all_finite(values)) return {};
  TimeMean result{mean_of(values), batch_interval(values), autocorrelation_time(values)};
  if (!result.interval) return result;
  const double n = double(values.size()), independent = std::max(n / result.correlation, 4.0);
  const double by_correlation =
      student_quantile(std::size_t(independent) - 1) * std::sqrt(result.correlation * squares_of(values) / (n - 1) / n);
  result.interval = std::max(*result.interval, by_correlation);
  return result;
}

Value interval_of_repeats(std::span<const double> values) {
  const std::size_t n = values.size();
  if (n < 4) return {};
  return student_quantile(n - 1) * std::sqrt(squares_of(values) / double(n - 1) / double(n));
}

std::size_t rows_to_drop(std::span<const double> values) {
  if (values.size() < 4 || !all_finite(values)) return 0;
  std::size_t best = 0;
  double least = 0, mean = 0, squares = 0;  // over the rows from d on (Welford)
  for (std::size_t d = values.size(), rows = 1; d-- > 0; ++rows) {
    const double before = values[d] - mean;
    mean += before / double(rows);
    squares += before * (values[d] - mean);
    const double rule = squares / (double(rows) * double(rows));
    if (d > values.size() / 2 || (d < values.size() / 2 && rule > least)) continue;
    best = d;
    least = rule;
  }
  return best;
}

std::vector<Rows> groups_of(std::size_t rows) {
  const std::size_t groups = std::min<std::size_t>(rows, 10);
  std::vector<Rows> found;
  for (std::size_t g = 0; groups >= 4 && g < groups; ++g) found.push_back({g * rows / groups, (g + 1) * rows / groups});
  return found;
}

std::vector<double> without(std::span<const double> values, const Rows& group) {
  std::vector<double> kept(values.begin(), values.end());
  kept.erase(kept.begin() + std::ptrdiff_t(group.begin), kept.begin() + std::ptrdiff_t(group.end));
  return kept;
}

std::optional<Jackknife> jackknife(std::span<const Value> values) {
  const std::size_t groups = values.size();
  if (groups < 4 || !std::all_of(values.begin(), values.end(), [](const Value& v) { return v.has_value(); })) return {};
  std::vector<double> known;
  for (const Value& value : values) known.push_back(*value);
  return Jackknife{std::sqrt(squares_of(known) * double(groups - 1) / double(groups)), groups - 1};
}

Value jackknife_interval(std::span<const Value> values) {
  const std::optional<Jackknife> found = jackknife(values);
  return found ? Value(found->interval()) : Value();
}

}  // namespace polybed::measures
