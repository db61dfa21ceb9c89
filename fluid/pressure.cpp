#include "fluid/pressure.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/operators.hpp"

namespace polybed::fluid {

using core::Field;
using core::Index;

Pressure::Pressure(const core::Grid& grid, double tolerance)
    : grid_(grid),
      tolerance_(tolerance),
      solver_(grid),
      divergence_(core::make_field(grid)),
      source_(core::make_field(grid)) {
  if (grid.metric) open_mobility_ = core::make_face_field(grid);
}

core::PoissonResult Pressure::solve(const FluxRate& rate, const core::FaceField& flux, double w, Field& pressure) {
  core::divergence(grid_, rate.free, source_);
  core::divergence(grid_, flux, divergence_);
  core::for_each_row(grid_, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) source_[c] = -(source_[c] + w * divergence_[c]);
  });
  if (!grid_.metric) return solver_.solve(core::spans(rate.mobility), {}, source_, pressure, tolerance_);
  open_mobility_ = rate.mobility;
  core::weigh_faces(grid_, open_mobility_);
  core::weigh_cells(grid_, source_);
  return solver_.solve(core::spans(open_mobility_), {}, source_, pressure, tolerance_);
}

void set_outlet_pressure(const core::Grid& grid, const Boundaries& boundaries, Field& pressure) {
  boundaries.fill_cells(pressure);
  for (const OpenFace& f : boundaries.open_faces()) pressure[std::size_t(f.beyond)] = 0;
  if (!boundaries.has_outlet() || !grid.ends(1, 1)) return;
  core::Box beyond = core::owned_cells(grid);
  beyond.lo[1] = grid.cells[1];
  beyond.hi[1] = grid.cells[1] + 1;
  core::for_each_row(grid, beyond,
                     [&](Index begin, Index end) { std::fill(pressure.begin() + begin, pressure.begin() + end, 0.0); });
}

double divergence_error(const core::Grid& grid, const core::FaceField& flux, double velocity_scale) {
  Field div = core::make_field(grid);
  core::divergence(grid, flux, div);
  double worst = 0;
  core::for_each_row(grid, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) worst = std::max(worst, std::abs(div[std::size_t(c)]));
  });
  return worst * grid.smallest_spacing() / velocity_scale;
}

}  // namespace polybed::fluid
