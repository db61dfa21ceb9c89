#include "fluid/convection.hpp"

namespace polybed::fluid {

using core::Index;

core::Field slipping(const core::Grid& grid, const Boundaries& boundaries, const core::Field& velocity, int axis) {
  core::Field filled = velocity;
  const core::Field& open = grid.metric->open[std::size_t(axis)];
  core::for_each_row(grid, core::owned_faces(grid, axis), [&](Index begin, Index end) {
    for (Index f = begin; f < end; ++f) {
      if (open[std::size_t(f)] > 0) continue;
      double sum = 0, count = 0;
      for (int across = 0; across < grid.dimensions; ++across)
        for (const Index next : {f - grid.stride(across), f + grid.stride(across)}) {
          if (across == axis || !(open[std::size_t(next)] > 0)) continue;
          sum += velocity[std::size_t(next)];
          ++count;
        }
      if (count > 0) filled[std::size_t(f)] = sum / count;
    }
  });
  for (int across = 0; across < grid.dimensions; ++across) boundaries.join(filled, across);
  return filled;
}

}  // namespace polybed::fluid
