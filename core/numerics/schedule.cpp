#include "core/numerics/schedule.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/case/scene.hpp"

namespace polybed::core {

bool same_time(double a, double b) {
  constexpr double relative = 1e-12;
  return a == b || std::abs(a - b) < relative * std::max(std::abs(a), std::abs(b));  // no number equals infinity
}

bool is_later(double a, double b) { return a > b && !same_time(a, b); }

double next_multiple(double every, double time) {
  if (!(every > 0)) return std::numeric_limits<double>::infinity();
  double count = std::floor(time / every);
  while (!is_later(count * every, time)) {
    const double next = count + 1;
    if (next == count) return std::numeric_limits<double>::infinity();  // too many to count
    count = next;
  }
  return count * every;
}

void join_times(Scene& scene) {
  using Table = std::vector<std::pair<double, double>>;
  std::vector<Table*> tables{&scene.inlet.superficial_velocity};
  for (Jet& jet : scene.jets) tables.push_back(&jet.superficial_velocity);
  for (Feed& feed : scene.feeds) tables.push_back(&feed.superficial_velocity);
  for (Discharge& discharge : scene.discharges) tables.push_back(&discharge.superficial_velocity);
  std::vector<double> times;
  for (const Table* table : tables)
    for (const auto& point : *table) times.push_back(point.first);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end(), [](double a, double b) { return same_time(a, b); }), times.end());
  for (Table* table : tables)
    for (auto& point : *table) point.first = *std::prev(std::upper_bound(times.begin(), times.end(), point.first));
}

}  // namespace polybed::core
