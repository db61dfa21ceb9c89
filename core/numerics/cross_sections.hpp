// The open shares of the layers of a round column: areas, chords and volumes are exact; what is smaller than half a
// cell belongs to a neighbour in its layer.
#pragma once

#include "core/numerics/metric.hpp"

namespace polybed::core {

/// One for all layers where there is no taper; else one for each layer and one for what lies on the top, whose low
/// faces alone count. \param column  all of it, as wide as its largest diameter  \param rings  about the low end along x
[[nodiscard]] std::vector<CrossSection> cross_sections(const Grid& column, bool rings, const Taper& taper);

/// Radius of a tapered column just above (side 1) or below (-1) a height, m.
[[nodiscard]] double radius_at(const Taper& taper, double height, int side);

}  // namespace polybed::core
