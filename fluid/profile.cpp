#include "fluid/profile.hpp"

#include "core/ranks.hpp"

namespace polybed::fluid {

std::vector<double> lateral_mean(const core::Grid& grid, std::span<const double> field) {
  std::vector<double> mean(std::size_t(grid.column_cells(1)), 0.0);
  const double layer_cells = double(grid.column_cells(0)) * grid.column_cells(2);
  for (int y = 0; y < grid.cells[1]; ++y) {
    const core::Box layer{{0, y, 0}, {grid.cells[0], y + 1, grid.cells[2]}};
    double sum = 0;
    core::for_each_row(grid, layer, [&](core::Index begin, core::Index end) {
      for (core::Index c = begin; c < end; ++c) sum += field[std::size_t(c)];
    });
    mean[std::size_t(grid.before[1] + y)] = sum / layer_cells;
  }
  core::add_over_ranks(grid, mean);
  return mean;
}

}  // namespace polybed::fluid
