// Rows of drag data from the boxes of polybed resolve.
#pragma once

#include <string>
#include <vector>

#include "multiscale/resolve/box_drag.hpp"

namespace polybed::multiscale {

/// Of one species.
struct RowValue {
  /// On the finest grid, means over the packings. Not extrapolated: the error of these walls changes its sign before it
  /// falls with the square of the cells, and the extrapolated value was farther from the limit (record of resolved
  /// flow).
  double net = 0, pure = 0;
  double net_error = 0;  ///< standard error over the packings; NaN of one packing
  double net_grid = 0;   ///< less the next coarser grid; NaN of one grid
};

/// \param boxes  [packing][grid]
[[nodiscard]] std::vector<RowValue> row_values(const std::vector<std::vector<BoxDrag>>& boxes);

/// Header and row: eps,Re,x1,D1,... as polybed drag reads them, D in m, then n_j,n_j_se,f_j of each species,
/// packings,resolution,spheres,imbalance and n_j_grid. What is not known is left empty.
[[nodiscard]] std::string row_header(std::size_t species);
[[nodiscard]] std::string row_text(const core::Scene& scene, double voidage, double reynolds,
                                   const std::vector<std::vector<BoxDrag>>& boxes);

/// A box as a line of text, and back; one that is none, or has a number that is not finite, gives nothing.
[[nodiscard]] std::string box_text(const BoxDrag& box);
[[nodiscard]] BoxDrag box_of_text(const std::string& text, std::size_t species);

/// A name that changes with everything that a box's result depends on.
[[nodiscard]] std::string box_name(const core::Scene& scene, const ResolvePoint& point);

}  // namespace polybed::multiscale
