#include "multiscale/cost/timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace polybed::multiscale {

namespace {

constexpr double most_noise = 0.1, parted = 1e-2, constant = 1e-9;

double quantile(const std::vector<double>& sorted, double q) {
  const double place = q * double(sorted.size() - 1);
  const auto low = std::size_t(place);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (place - double(low)) * (sorted[high] - sorted[low]);
}

}  // namespace

Timing timing_of(std::span<const double> seconds) {
  if (seconds.empty()) throw std::invalid_argument("no times");
  std::vector<double> sorted(seconds.begin(), seconds.end());
  std::sort(sorted.begin(), sorted.end());
  Timing timing;
  timing.median = quantile(sorted, 0.5);
  timing.quartiles = quantile(sorted, 0.75) - quantile(sorted, 0.25);
  for (double& s : sorted) s = std::abs(s - timing.median);
  std::sort(sorted.begin(), sorted.end());
  timing.deviation = quantile(sorted, 0.5);
  return timing;
}

std::optional<std::string> too_noisy(const Timing& timing, double load, double cores) {
  if (timing.quartiles > most_noise * timing.median)
    return fmt::format("machine busy: half of the times of one run span {:.0f} % of their median",
                       100 * timing.quartiles / timing.median);
  if (load > cores) return fmt::format("machine busy: load {:.1f} on {:.0f} cores", load, cores);
  return std::nullopt;
}

bool is_chaotic(std::span<const double> signal, std::span<const double> twin) {
  const std::size_t n = std::min(signal.size(), twin.size());
  if (n < 2) return false;
  double mean = 0, square = 0, distance = 0;
  for (std::size_t k = 0; k < n; ++k) mean += signal[k] / double(n);
  for (std::size_t k = 0; k < n; ++k) {
    square += std::pow(signal[k] - mean, 2) / double(n);
    distance = std::max(distance, std::abs(signal[k] - twin[k]));
  }
  const double deviation = std::sqrt(square);
  return deviation > constant * std::abs(mean) && distance > parted * deviation;
}

}  // namespace polybed::multiscale
