#include "tfm/first_order_fallback.hpp"

#include <algorithm>
#include <utility>

#include "core/ranks.hpp"
#include "tfm/mixture.hpp"

namespace polybed::tfm {

using core::Index;

namespace {

/// phi_j of an owned cell in a state: the fractions stand first, species by species.
double fraction(const StateLayout& layout, std::span<const double> y, std::size_t species, std::size_t cell) {
  return y[layout.entries()[species].begin + cell];
}

}  // namespace

void FirstOrderFallback::see(const StateLayout& layout, std::span<const double> y, const StressEffect* stress) {
  const core::Grid& grid = constants_.grid;
  std::vector<std::size_t> out;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell)
    if (out_of_bounds(layout, y, cell, stress)) out.push_back(cell);
  if (left_.empty()) {  // on one rank as on all
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

bool FirstOrderFallback::out_of_bounds(const StateLayout& layout, std::span<const double> y, std::size_t cell,
                                       const StressEffect* stress) {
  const std::size_t n = constants_.species();
  double least = 0, sum = 0, seen = composition_floor;
  for (std::size_t j = 0; j < n; ++j) {
    const double phi = fraction(layout, y, j, cell);
    least = std::min(least, phi);
    sum += phi;
    seen += std::max(phi, 0.0);
  }
  if (least < least_) return true;
  if (stress == nullptr) return false;
  share_.resize(n);
  for (std::size_t j = 0; j < n; ++j)
    share_[j] = (std::max(fraction(layout, y, j, cell), 0.0) + composition_floor * constants_.bed_share[j]) / seen;
  return sum > stress->packing_of(share_) + overshoot;
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
