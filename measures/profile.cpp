#include "measures/profile.hpp"

#include <algorithm>

#include "core/numerics/metric.hpp"
#include "core/numerics/ranks.hpp"

namespace polybed::measures {

Profile on_slabs(const Profile& profile, double slab, std::size_t count) {
  const auto spread = [&](const std::vector<double>& values) {
    std::vector<double> found(count, 0.0);
    for (std::size_t k = 0; k < count; ++k) {
      const double bottom = double(k) * slab, top = bottom + slab;
      const auto first = std::size_t(bottom / profile.slab);
      for (std::size_t n = first > 0 ? first - 1 : 0; n < values.size() && double(n) * profile.slab < top; ++n) {
        const double low = double(n) * profile.slab;
        found[k] += values[n] * std::max(0.0, std::min(top, low + profile.slab) - std::max(bottom, low)) / slab;
      }
    }
    return found;
  };
  Profile other;
  other.slab = slab;
  if (!profile.areas.empty()) other.areas = spread(profile.areas);
  for (std::vector<double> phi : profile.fraction) {
    for (std::size_t k = 0; k < profile.areas.size(); ++k) phi[k] *= profile.areas[k];
    other.fraction.push_back(spread(phi));
    for (std::size_t k = 0; k < other.areas.size(); ++k)
      if (other.areas[k] > 0) other.fraction.back()[k] /= other.areas[k];
  }
  if (!profile.pressure.empty()) other.pressure = spread(profile.pressure);
  return other;
}

std::vector<double> part_of_lateral_mean(const core::Grid& grid, std::span<const double> field) {
  std::vector<double> mean(std::size_t(grid.column_cells(1)), 0.0);
  const double* open = grid.metric ? grid.metric->volume.data() : nullptr;
  for (int y = 0; y < grid.cells[1]; ++y) {
    const core::Box layer{{0, y, 0}, {grid.cells[0], y + 1, grid.cells[2]}};
    double sum = 0;
    core::for_each_row(grid, layer, [&](core::Index begin, core::Index end) {
      for (core::Index c = begin; c < end; ++c) sum += (open ? open[c] : 1.0) * field[std::size_t(c)];
    });
    mean[std::size_t(grid.before[1] + y)] = sum / core::open_cells_of_layer(grid, grid.before[1] + y);
  }
  return mean;
}

std::vector<double> lateral_mean(const core::Grid& grid, std::span<const double> field) {
  std::vector<double> mean = part_of_lateral_mean(grid, field);
  core::add_over_ranks(grid, mean);
  return mean;
}

}  // namespace polybed::measures
