// Rows of drag data from the boxes of polybed resolve.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "multiscale/resolve/box_drag.hpp"

namespace polybed::multiscale {

/// A value over the packings on the finest grid. Not extrapolated: the error of these walls changes its sign before it
/// falls with the square of the cells, and the extrapolated value was farther from the limit (record of resolved flow).
struct RowValue {
  double mean = 0;
  double error = 0;  ///< standard error over the packings; NaN for one packing
  double grid = 0;   ///< minus the next coarser grid's; NaN for one grid
};

/// Boxes of a row: [packing][grid][as passed()].
using RowBoxes = std::vector<std::vector<std::vector<BoxDrag>>>;

/// \param value  for the boxes of one packing on one grid
[[nodiscard]] RowValue row_value(const RowBoxes& boxes,
                                 const std::function<double(const std::vector<BoxDrag>&)>& value);

/// Header and row: eps,Re,x1,D1,... as polybed drag reads them, D in m; then for each species n_j,n_j_se,f_j; for
/// moving spheres f_j_k,f_j_k_se from the relative motion of species k, whose sum is f_j; for free spheres
/// u_j,u_j_se,f_j,v_j,w_j. Then packings,resolution,spheres,imbalance, for free spheres cell_Re, and n_j_grid or
/// u_j_grid. Unknown values are empty.
[[nodiscard]] std::string row_header(const core::Scene& scene);
[[nodiscard]] std::string row_text(const core::Scene& scene, double voidage, double reynolds, const RowBoxes& boxes);

/// Header and lines eps,Re,j,k,r,g,g_se of a row of free spheres: the pair distribution of species j and k at the
/// distance r over that at contact. Nothing where boxes have none.
[[nodiscard]] std::string pair_header();
[[nodiscard]] std::string pair_text(const core::Scene& scene, double voidage, const RowBoxes& boxes);

/// What the standard errors of rows over so many packings are worth: a 95 % interval from four on, as of all means.
[[nodiscard]] std::string interval_text(int packings);

/// A box as a line of text, and back; nothing for an invalid line or a number that is not finite.
[[nodiscard]] std::string box_text(const BoxDrag& box);
[[nodiscard]] BoxDrag box_of_text(const std::string& text, const core::Scene& scene);

/// A name that changes with every input of a box's result.
[[nodiscard]] std::string box_name(const core::Scene& scene, const ResolvePoint& point);

}  // namespace polybed::multiscale
