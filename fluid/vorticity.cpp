#include "fluid/vorticity.hpp"

#include "core/numerics/metric.hpp"

namespace polybed::fluid {

using core::Field;
using core::Index;

namespace {

/// Adds sign dU_of/dx_along: the mean of U on a cell's two faces, from the previous cell to the next.
void add_slope(const core::Grid& grid, const core::FaceField& velocity, int of, int along, double sign, Field& out) {
  const Field& u = velocity[std::size_t(of)];
  const Index to_high = grid.stride(of), s = grid.stride(along);
  const double even = sign / (4 * grid.spacing[std::size_t(along)]);
  const auto add = [&](const auto& scale) {
    core::for_each_row(grid, core::owned_cells(grid), [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c)
        out[std::size_t(c)] += scale(c) * ((u[std::size_t(c + s)] - u[std::size_t(c - s)]) +
                                           (u[std::size_t(c + s + to_high)] - u[std::size_t(c - s + to_high)]));
    });
  };
  if (!grid.graded(along)) return add([even](Index) { return even; });
  const Field& per_distance = grid.metric->per_distance[std::size_t(along)];
  add([&](Index c) { return even * 2 / (1 / per_distance[std::size_t(c)] + 1 / per_distance[std::size_t(c + s)]); });
}

}  // namespace

void find_vorticity(const core::Grid& grid, const core::FaceField& velocity, std::array<Field, 3>& vorticity) {
  for (Field& component : vorticity) component.assign(grid.padded_size(), 0.0);
  add_slope(grid, velocity, 1, 0, 1, vorticity[2]);
  add_slope(grid, velocity, 0, 1, -1, vorticity[2]);
  if (grid.dimensions < 3) return;
  add_slope(grid, velocity, 2, 1, 1, vorticity[0]);
  add_slope(grid, velocity, 1, 2, -1, vorticity[0]);
  add_slope(grid, velocity, 0, 2, 1, vorticity[1]);
  add_slope(grid, velocity, 2, 0, -1, vorticity[1]);
}

}  // namespace polybed::fluid
