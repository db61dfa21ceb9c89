// The open shares of the layers of a round column. Areas, chords and volumes are exact; a cell that is less than half
// open is merged with a neighbour in its layer.
#pragma once

#include "core/numerics/metric.hpp"

namespace polybed::core {

/// One entry for all layers without a taper and ducts; else one per layer and one for the top, of which only the low
/// faces count. Between layers only the circle is open, so a duct several layers high is no shaft.
/// \param column  all of it, as wide as its largest diameter  \param rings  about the low end along x
/// \param ducts   to ports in the side of a cylinder
[[nodiscard]] std::vector<CrossSection> cross_sections(const Grid& column, bool rings, const Taper& taper,
                                                       const Ducts& ducts = {});

/// Radius of a tapered column just above (side 1) or below (-1) a height, m.
[[nodiscard]] double radius_at(const Taper& taper, double height, int side);

}  // namespace polybed::core
