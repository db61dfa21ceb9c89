// A bed in a column whose cross-section changes: its height from its volume, slice by slice.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::multiscale {

/// Slices of a column whose cross-section changes, by a taper or walls inside.
struct Slices {
  std::vector<double> height;  ///< m
  std::vector<double> even;    ///< open volume over the area of the bottom, m
  bool between_walls = false;

  [[nodiscard]] bool empty() const { return height.empty(); }
  /// Whether the column is wider at a height than at the bottom.
  [[nodiscard]] bool widens_to(double top) const {
    std::size_t n = 0;
    for (double low = height[0]; low < top && n + 1 < height.size(); low += height[n]) ++n;
    return even[n] / height[n] > even[0] / height[0] * (1 + 1e-9);
  }
};

/// Empty for a column with one cross-section.
[[nodiscard]] Slices slices_of(const core::Scene& scene);

/// A bed in slices, each at its own solids fraction.
struct Filled {
  double height = 0, solids = 0;  ///< m; integral of the solids fraction over the height, m
};

/// Fills slices from the bottom. The column goes on above its top with the width of its top; nothing if the bed would
/// be four times as high. \param solids  volume over the area of the bottom, m  \param fraction  slice -> solids fraction
template <class Fraction>
std::optional<Filled> fill(const Slices& slices, double solids, const Fraction& fraction) {
  Filled bed;
  for (std::size_t n = 0; n < 4 * slices.height.size(); ++n) {
    const std::size_t at = std::min(n, slices.height.size() - 1);
    const double phi = std::max(fraction(at), 0.0), here = phi * slices.even[at];
    const double share = here > 0 ? std::min(solids / here, 1.0) : 1;
    bed.height += share * slices.height[at];
    bed.solids += share * slices.height[at] * phi;
    if (here > 0 && solids <= here) return bed;
    solids -= here;
  }
  return std::nullopt;
}

}  // namespace polybed::multiscale
