#include "measures/drift.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "measures/window.hpp"

namespace polybed::measures {

namespace {

constexpr std::size_t parts = 10;
constexpr double matters = 1e-3, of_a_cell = 0.05;  // of the bed's height; of the height of a cell

struct Parts {
  std::array<double, parts> time{}, value{};
};

std::optional<Parts> means_of_parts(std::span<const double> time, std::span<const double> value) {
  Parts sum;
  std::array<double, parts> count{};
  const double begin = time.front(), length = time.back() - begin;
  for (std::size_t n = 0; n < time.size(); ++n) {
    const auto part = std::min(std::size_t(double(parts) * (time[n] - begin) / length), parts - 1);
    sum.time[part] += time[n];
    sum.value[part] += value[n];
    ++count[part];
  }
  for (std::size_t part = 0; part < parts; ++part) {
    if (count[part] == 0) return std::nullopt;
    sum.time[part] /= count[part];
    sum.value[part] /= count[part];
  }
  return sum;
}

}  // namespace

std::optional<Drift> drift_of(std::span<const double> time, std::span<const double> value) {
  if (time.empty() || !(time.back() > time.front())) return std::nullopt;
  const auto means = means_of_parts(time, value);
  if (!means) return std::nullopt;
  double t_mean = 0, y_mean = 0, tt = 0, ty = 0, left = 0;
  for (std::size_t n = 0; n < parts; ++n) {
    t_mean += means->time[n] / parts;
    y_mean += means->value[n] / parts;
  }
  for (std::size_t n = 0; n < parts; ++n) {
    tt += (means->time[n] - t_mean) * (means->time[n] - t_mean);
    ty += (means->time[n] - t_mean) * (means->value[n] - y_mean);
  }
  Drift drift{ty / tt, 0};
  for (std::size_t n = 0; n < parts; ++n) {
    const double residual = means->value[n] - y_mean - drift.rate * (means->time[n] - t_mean);
    left += residual * residual;
  }
  drift.error = student_quantile(parts - 2) * std::sqrt(left / (parts - 2) / tt);
  return drift;
}

std::vector<DriftOfMeasure> drifts_of(std::span<const double> time, const std::vector<HeightSeries>& heights,
                                      double cell) {
  std::vector<DriftOfMeasure> found;
  if (time.empty()) return found;
  const Rows rows = last_quarter(time).rows(time);
  for (const auto& [name, values, settling] : heights) {
    const auto drift = drift_of(rows.of(time), rows.of(values));
    if (!drift || !std::isfinite(drift->rate)) continue;
    const double moved = std::abs(drift->rate) * std::max(time.back() - time.front(), settling);
    const bool steady = std::abs(drift->rate) <= drift->error ||
                        moved <= std::max(matters * heights[0].values.back(), of_a_cell * cell);
    found.push_back({name, *drift, steady});
  }
  return found;
}

}  // namespace polybed::measures
