// The parts that a bed starts in: bed values that follow from [[layer]], and the position of each part.
#pragma once

#include <array>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::core {

/// Solids of one composition that fill a box, on top of the parts below.
struct BedPart {
  std::array<double, 2> from{0, 0}, to{1, 1};  ///< across the width and the depth of the column, as shares of them
  std::vector<double> solids;                  ///< volume of each species over the area of the part, m
  double solids_fraction = 0;                  ///< at the start; 0: not given

  [[nodiscard]] double all_solids() const;
  /// Share of the column's cross-section.
  [[nodiscard]] double area() const { return (to[0] - from[0]) * (to[1] - from[1]); }
};

/// The parts of a bed at its start, from the bottom up: the layers of [[layer]] if the start is "layered" or
/// "checkpoint"; without [[layer]], the groups of bed.layer if it is "layered"; otherwise one part, the whole bed.
/// \pre the amount is known: bed.particles, or bed.volume_share of every species
[[nodiscard]] std::vector<BedPart> start_parts(const Scene& scene);

/// Heights of the lower and the upper face of a part, m.
struct Extent {
  double low = 0, high = 0;
};

/// Positions of parts of these heights, m. Each rests on the highest of the earlier parts below it.
[[nodiscard]] std::vector<Extent> stacked(const std::vector<BedPart>& parts, const std::vector<double>& height);

/// The same from the solids fraction of each part at the start. In a tapered column a part is as wide as the column.
[[nodiscard]] std::vector<Extent> stacked(const std::vector<BedPart>& parts, const Column& column);

/// Height of the highest part, m; 0 without parts.
[[nodiscard]] double top_of(const std::vector<Extent>& extents);

/// Share of the cross-section of part n that rests on parts whose top is at its lower face.
/// \param extents  of all parts
[[nodiscard]] double supported_share(const std::vector<BedPart>& parts, const std::vector<Extent>& extents,
                                     std::size_t n);

/// Totals of the layers, for the keys of [bed].
struct LayerTotals {
  double solids = 0;          ///< volume over the cross-section of the column, m
  std::vector<double> share;  ///< share of each species in it
};

/// \param scene  with a volume_share of every species and a solids_fraction in each layer
[[nodiscard]] LayerTotals totals_of_layers(const Scene& scene);

/// Solids fractions of the settled bed and of what each species settles in: of layers in the mean by volume.
struct SettledFractions {
  double of_bed = 0;
  std::vector<double> of_species;
};

/// \pre as of totals_of_layers; without layers all are bed.solids_fraction
[[nodiscard]] SettledFractions settled_fractions(const Scene& scene);

/// Solids fraction of the loosest settled part: of the bed and of each layer.
[[nodiscard]] double loosest_settled(const Scene& scene);

/// Fills in volume_share and solids_fraction of each layer and, where the case gives none, of the bed: volume_share,
/// static_height (of the same solids over the whole cross-section) and solids_fraction (of the densest layer).
/// \pre the keys of the layers are sound
void fill_layers(Scene& scene);

}  // namespace polybed::core
