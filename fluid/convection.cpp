#include "fluid/convection.hpp"

#include <algorithm>

namespace polybed::fluid {

using core::Index;

core::Field slipping(const core::Grid& grid, const Boundaries& boundaries, const core::Field& velocity, int axis,
                     const std::array<std::vector<Index>, 3>& steps) {
  core::Field filled = velocity;
  const core::Field& open = grid.metric->open[std::size_t(axis)];
  for (const Index f : steps[std::size_t(axis)])
    for (const bool joined : {true, false}) {  // first from faces on the same side of a thin wall
      double sum = 0, count = 0;
      for (int across = 0; across < grid.dimensions; ++across)
        for (const Index next : {f - grid.stride(across), f + grid.stride(across)}) {
          if (across == axis || !(open[std::size_t(next)] > 0)) continue;
          const core::Field& between = grid.metric->open[std::size_t(across)];
          const auto edge = std::size_t(std::max(f, next)), low = edge - std::size_t(grid.stride(axis));
          if (joined && !(between[edge] > 0 || between[low] > 0)) continue;
          sum += velocity[std::size_t(next)];
          ++count;
        }
      if (count > 0) {
        filled[std::size_t(f)] = sum / count;
        break;
      }
    }
  for (int across = 0; across < grid.dimensions; ++across) boundaries.join(filled, across);
  return filled;
}

core::FaceField along_walls_inside(const core::Grid& grid, const Boundaries& boundaries,
                                   const core::FaceField& velocity) {
  core::FaceField filled;
  for (int axis = 0; axis < grid.dimensions; ++axis)
    filled[std::size_t(axis)] =
        slipping(grid, boundaries, velocity[std::size_t(axis)], axis, grid.metric->steps_inside);
  return filled;
}

}  // namespace polybed::fluid
