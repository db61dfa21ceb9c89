#include "tfm/first_order_fallback.hpp"

#include <algorithm>
#include <utility>

#include "core/numerics/ranks.hpp"
#include "tfm/packing_limit.hpp"

namespace polybed::tfm {

using core::Index;

void FirstOrderFallback::see(const StateLayout& layout, std::span<const double> y, const StressEffect* stress) {
  const core::Grid& grid = constants_.grid;
  const double least = least_packing(constants_, stress);
  std::vector<std::size_t> out;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell)
    if (const CellSolids is = solids_of(constants_, layout, y, cell, stress, least);
        is.least < least_ || is.above_packing > overshoot)
      out.push_back(cell);
  if (left_.empty()) {  // the same on all ranks
    if (core::sum_of_ranks(grid, double(out.size())) == 0) return;
    left_.assign(grid.cell_count(), 0.0);
  }
  double fresh = 0;
  for (const std::size_t cell : out) fresh += left_[cell] == 0;
  for (double& left : left_) left = std::max(left - 1, 0.0);
  for (const std::size_t cell : out) left_[cell] = steps;
  const double flagged = double(std::count_if(left_.begin(), left_.end(), [](double left) { return left > 0; }));
  count_ += std::uint64_t(core::sum_of_ranks(grid, fresh));
  if (core::sum_of_ranks(grid, flagged) == 0) left_.clear();
  list_faces(layout);
}

void FirstOrderFallback::list_faces(const StateLayout& layout) {
  for (auto& list : faces_) list.clear();
  if (left_.empty()) return;
  core::Field flag = core::make_field(constants_.grid);
  layout.unpack(layout.entries().front(), left_, flag);
  boundaries_.fill_cells(flag);
  for (int axis = 0; axis < constants_.grid.dimensions; ++axis) {
    const Index s = constants_.grid.stride(axis);
    core::for_each_row(constants_.grid, boundaries_.moving_faces_of_cells(axis, false), [&](Index begin, Index end) {
      for (Index f = begin; f < end; ++f)
        if (flag[std::size_t(f)] > 0 || flag[std::size_t(f - s)] > 0) faces_[std::size_t(axis)].push_back(f);
    });
  }
}

void FirstOrderFallback::restore(const StateLayout& layout, std::vector<double> steps_left, std::uint64_t count) {
  left_ = std::move(steps_left);
  count_ = count;
  list_faces(layout);
}

}  // namespace polybed::tfm
