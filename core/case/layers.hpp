// The parts that a bed starts in: what of the bed follows from [[layer]], and where each part lies.
#pragma once

#include <array>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::core {

/// Solids of one composition that stand in a box, on what lies below them.
struct BedPart {
  std::array<double, 2> from{0, 0}, to{1, 1};  ///< across the width and the depth of the column, as shares of them
  std::vector<double> solids;                  ///< volume of each species over the area of the part, m
  double solids_fraction = 0;                  ///< at the start; 0: not given

  [[nodiscard]] double all_solids() const;
  /// Over the cross-section of the column.
  [[nodiscard]] double area() const { return (to[0] - from[0]) * (to[1] - from[1]); }
};

/// The parts of a bed at its start, in the order in which they lie on each other: those of [[layer]] for the starts
/// "layered" and "checkpoint", those of bed.layer for "layered" without them, else the whole bed. The amount must be
/// known: bed.particles, or bed.volume_share of every species.
[[nodiscard]] std::vector<BedPart> start_parts(const Scene& scene);

/// Heights of the lower and the upper face of a part, m.
struct Extent {
  double low = 0, high = 0;
};

/// Where parts of these heights, m, lie: each on the highest of those before it that it lies over.
[[nodiscard]] std::vector<Extent> stacked(const std::vector<BedPart>& parts, const std::vector<double>& height);

/// The same for parts as high as their solids are at the fraction of the start.
[[nodiscard]] std::vector<Extent> stacked(const std::vector<BedPart>& parts);

/// Height of the highest part, m; 0 without parts.
[[nodiscard]] double top_of(const std::vector<Extent>& extents);

/// Shares of those parts of the cross-section of a part that lie over ones before it, up to its own lower face.
/// \param n  which  \param extents  of all
[[nodiscard]] double supported_share(const std::vector<BedPart>& parts, const std::vector<Extent>& extents,
                                     std::size_t n);

/// What of [bed] follows from the layers.
struct LayerTotals {
  double solids = 0;          ///< volume over the cross-section of the column, m
  std::vector<double> share;  ///< of each species in it
};

/// \param scene  with a volume_share of every species and a solids_fraction in each layer
[[nodiscard]] LayerTotals totals_of_layers(const Scene& scene);

/// Gives each layer its volume_share and its solids_fraction, and the bed what it does not say itself: volume_share,
/// static_height (of the same solids over the whole cross-section) and solids_fraction (of the densest layer). The
/// keys of the layers must be sound.
void fill_layers(Scene& scene);

}  // namespace polybed::core
