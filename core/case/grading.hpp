// The layers of cells of a column whose upper part is graded: each layer there is higher than the one below it.
#pragma once

#include <vector>

namespace polybed::core {

/// Heights of the layers from the bottom up, m. Those that begin below `above` have the height of even cells. Above it
/// they grow, each by the same factor: the largest up to `ratio` with which a whole number of layers fits.
/// \param cells  number of even layers in the whole height  \param above  m, between 0 and the height
/// \param ratio  of the heights of neighbours, at least 1
[[nodiscard]] std::vector<double> graded_layers(double height, int cells, double above, double ratio);

}  // namespace polybed::core
