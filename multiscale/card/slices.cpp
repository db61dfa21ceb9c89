#include "multiscale/card/slices.hpp"

#include "core/numerics/blocks.hpp"
#include "core/numerics/metric.hpp"

namespace polybed::multiscale {

Slices slices_of(const core::Scene& scene) {
  constexpr int count = 200;
  const core::Column& column = scene.column;
  Slices slices;
  if (scene.fluid.present() && !scene.walls.empty()) {
    const core::Grid grid = core::grid_of(scene, nullptr);
    slices.between_walls = true;
    for (int y = 0; y < grid.cells[1]; ++y) {
      slices.height.push_back(grid.height(y));
      slices.even.push_back(core::open_cells_of_layer(grid, y) / core::open_faces_below(grid, 0) * grid.spacing[1]);
    }
    return slices;
  }
  for (int n = 0; n < count && column.is_tapered(); ++n) {
    const double low = n * column.size[1] / count, high = (n + 1) * column.size[1] / count;
    slices.height.push_back(high - low);
    slices.even.push_back(column.even_height(high) - column.even_height(low));
  }
  return slices;
}

}  // namespace polybed::multiscale
