// How strongly elastic waves of a packed bed are damped.
#pragma once

#include <algorithm>

#include "core/case/scene.hpp"
#include "core/numerics/grid.hpp"

namespace polybed::tfm {

/// alpha of the bulk viscosity alpha rho_s c_s h, dimensionless: as the case says, or 1 over the number of directions
/// with more than one cell. It acts in all directions at once, so that an explicit step may take some h/(2 d alpha c_s)
/// in d of them: with alpha = 1 in two dimensions nothing else bound the steps of a packed bed (docs/record/cost.md).
[[nodiscard]] inline double bulk_viscosity_of(const core::Scene& scene, const core::Grid& grid) {
  int directions = 0;
  for (int axis = 0; axis < grid.dimensions; ++axis) directions += grid.column_cells(axis) > 1 ? 1 : 0;
  return scene.tfm.bulk_viscosity.value_or(1.0 / std::max(directions, 1));
}

}  // namespace polybed::tfm
