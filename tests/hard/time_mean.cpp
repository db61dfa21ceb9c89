#include "hard/time_mean.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace polybed::hard {

namespace {

double mean_of(std::span<const double> values) {
  // About the first one, so that the mean of equal numbers is that number.
  double sum = 0;
  for (const double v : values) sum += v - values.front();
  return values.front() + sum / double(values.size());
}

/// Sum of squares about the mean.
double squares_of(std::span<const double> values) {
  const double mean = mean_of(values);
  double sum = 0;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return sum;
}

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// Half-width by batch means; the rows that do not fill a batch are left out at the beginning.
std::optional<double> batch_error(std::span<const double> values) {
  const std::size_t batches = values.size() >= 40 ? 20 : 10, length = values.size() / batches;
  if (length < 2) return std::nullopt;
  const std::span<const double> used = values.last(batches * length);
  std::vector<double> means;
  for (std::size_t b = 0; b < batches; ++b) means.push_back(mean_of(used.subspan(b * length, length)));
  return student_quantile(batches - 1) * std::sqrt(squares_of(means) / double(batches - 1) / double(batches));
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

double autocorrelation_time(std::span<const double> values) {
  const std::size_t n = values.size();
  if (n < 2) return 1;
  const double mean = mean_of(values), square = squares_of(values);
  if (!(square > 0)) return 1;
  double sum = 1;
  for (std::size_t lag = 1; lag < n; ++lag) {
    double product = 0;
    for (std::size_t k = 0; k + lag < n; ++k) product += (values[k] - mean) * (values[k + lag] - mean);
    sum += 2 * product / square;
    if (double(lag) >= 2.5 * sum) break;
  }
  return std::max(sum, 1.0);
}

std::optional<TimeMean> time_mean(std::span<const double> values) {
  if (values.empty() || !all_finite(values)) return std::nullopt;
  TimeMean result{mean_of(values), batch_error(values), autocorrelation_time(values)};
  if (!result.error) return result;
  const double n = double(values.size()), independent = std::max(n / result.correlation, 4.0);
  const double by_correlation =
      student_quantile(std::size_t(independent) - 1) * std::sqrt(result.correlation * squares_of(values) / (n - 1) / n);
  result.error = std::max(*result.error, by_correlation);
  return result;
}

std::size_t rows_to_drop(std::span<const double> values) {
  if (values.size() < 4 || !all_finite(values)) return 0;
  std::size_t best = 0;
  double least = 0;
  for (std::size_t d = 0; d <= values.size() / 2; ++d) {
    const std::span<const double> kept = values.subspan(d);
    const double rule = squares_of(kept) / (double(kept.size()) * double(kept.size()));
    if (d == 0 || rule < least) {
      best = d;
      least = rule;
    }
  }
  return best;
}

std::optional<Jackknife> jackknife(std::size_t rows,
                                   const std::function<std::optional<double>(const std::vector<bool>&)>& value) {
  const std::size_t groups = std::min<std::size_t>(rows, 10);
  if (groups < 4) return std::nullopt;
  std::vector<double> without;
  for (std::size_t g = 0; g < groups; ++g) {
    std::vector<bool> kept(rows, true);
    for (std::size_t k = g * rows / groups; k < (g + 1) * rows / groups; ++k) kept[k] = false;
    const auto found = value(kept);
    if (!found) return std::nullopt;
    without.push_back(*found);
  }
  return Jackknife{squares_of(without) * double(groups - 1) / double(groups), groups - 1};
}

}  // namespace polybed::hard
