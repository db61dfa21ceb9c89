#include "tfm/parts/follow_bed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numerics/ranks.hpp"

namespace polybed::tfm {

void FollowBed::prepare(std::span<const double> y) {
  constexpr double trace = 1e-12;  // of the fraction: it stays where it is
  constexpr int margin = 8;
  const core::Grid& grid = equations_.constants().grid;
  const auto holds_solids = [&](int row) {
    const auto nx = std::size_t(grid.cells[0]);
    for (const StateLayout::Entry& entry : layout_.entries())
      for (int k = 0; k < grid.cells[2] && entry.kind == StateLayout::Entry::Kind::fraction; ++k) {
        const auto cells =
            y.subspan(entry.begin + (std::size_t(k) * std::size_t(grid.cells[1]) + std::size_t(row)) * nx, nx);
        if (std::any_of(cells.begin(), cells.end(), [](double phi) { return std::abs(phi) > trace; })) return true;
      }
    return false;
  };
  int rows = grid.cells[1];
  while (rows > 0 && !holds_solids(rows - 1)) --rows;
  const int held = int(core::greatest_of_ranks(grid, rows > 0 ? grid.before[1] + rows : 0)) + margin;
  equations_.hold_solids_above(held < grid.column_cells(1) ? held : std::numeric_limits<int>::max());
}

}  // namespace polybed::tfm
