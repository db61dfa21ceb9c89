// The layers of cells of a graded column: each layer above the bed is higher than the one below it, and cells across
// are wider towards the middle.
#pragma once

#include <vector>

namespace polybed::core {

/// Heights of the layers from the bottom up, m. Those that begin below `above` have the height of even cells. Above it
/// they grow, each by the same factor: the largest up to `ratio` with which a whole number of layers fits.
/// \param cells  number of even layers in the whole height  \param above  m, between 0 and the height
/// \param ratio  of the heights of neighbours, at least 1
[[nodiscard]] std::vector<double> graded_layers(double height, int cells, double above, double ratio);

/// Widths of cells between two walls, m: each wider by the same factor than its neighbour towards the nearer wall.
/// \param cells  their number  \param ratio  at least 1
[[nodiscard]] std::vector<double> graded_widths(double width, int cells, double ratio);

}  // namespace polybed::core
