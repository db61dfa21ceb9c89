#include "measures/profile.hpp"

#include <algorithm>
#include <cmath>

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

std::size_t slabs_of(const core::Grid& grid) {
  return grid.layers ? std::size_t(std::lround(grid.column_height() / grid.spacing[1]))
                     : std::size_t(grid.column_cells(1));
}

namespace {

std::vector<double> even_on_slabs(const core::Grid& grid, const std::vector<double>& values) {
  std::vector<double> slabs(slabs_of(grid), 0.0);
  const double h = grid.spacing[1];
  for (std::size_t y = 0; y < values.size(); ++y) {
    const double low = grid.low(1, int(y)), high = grid.low(1, int(y) + 1);
    for (auto k = std::size_t(low / h * (1 - 1e-12)); k < slabs.size() && double(k) * h < high; ++k)
      slabs[k] += values[y] * std::max(0.0, std::min(high, double(k + 1) * h) - std::max(low, double(k) * h)) / h;
  }
  return slabs;
}

/// Beyond the outermost centres as between the two next to them.
std::vector<double> linear_on_slabs(const core::Grid& grid, const std::vector<double>& values) {
  std::vector<double> slabs;
  const auto centre = [&](std::size_t y) { return 0.5 * (grid.low(1, int(y)) + grid.low(1, int(y) + 1)); };
  std::size_t below = 0;
  for (std::size_t k = 0; k < slabs_of(grid); ++k) {
    const double here = (double(k) + 0.5) * grid.spacing[1];
    while (below + 2 < values.size() && centre(below + 1) < here) ++below;
    const double share = (here - centre(below)) / (centre(below + 1) - centre(below));
    slabs.push_back((1 - share) * values[below] + share * values[below + 1]);
  }
  return slabs;
}

}  // namespace

std::vector<double> areas_of_slabs(const core::Grid& grid) {
  std::vector<double> areas = core::areas_of_layers(grid);
  return grid.layers && !areas.empty() ? even_on_slabs(grid, areas) : areas;
}

std::vector<double> part_of_lateral_mean(const core::Grid& grid, std::span<const double> field, Within layers) {
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
  if (!grid.layers) return mean;
  if (layers == Within::linear) return linear_on_slabs(grid, mean);
  const std::vector<double> area = core::areas_of_layers(grid);
  for (std::size_t y = 0; y < area.size(); ++y) mean[y] *= area[y];
  std::vector<double> slabs = even_on_slabs(grid, mean);
  const std::vector<double> areas = areas_of_slabs(grid);
  for (std::size_t k = 0; k < areas.size(); ++k) slabs[k] /= areas[k];
  return slabs;
}

std::vector<double> lateral_mean(const core::Grid& grid, std::span<const double> field, Within layers) {
  std::vector<double> mean = part_of_lateral_mean(grid, field, layers);
  core::add_over_ranks(grid, mean);
  return mean;
}

}  // namespace polybed::measures
