// How far a state is from the limit beyond which the equations are ill-posed, so that finer cells show other waves and
// no grid converges.
#pragma once

#include <array>
#include <limits>
#include <string>

#include "tfm/fields.hpp"

namespace polybed::tfm {

/// G/G_crit, closures/well_posedness.hpp, over the cells with solids: below 1 the equations are ill-posed there.
struct PosednessMargin {
  double least = std::numeric_limits<double>::infinity();  ///< infinite where nothing slips
  std::array<int, 3> cell{};                               ///< of the column, where it is least
  double share = 0;                                        ///< of the cells with solids, those below 1
};

/// Solids fraction below which a cell counts as empty.
constexpr double posedness_fraction = 1e-3;

/// From the fields of a finished evaluation, cell by cell, with the solids of all species taken as one: their mean
/// density and slip by volume, and G the slope of their shared pressure without its bulk-viscous part. Added mass and
/// the solids' viscosity, which shift the limit, are not seen. Collective.
[[nodiscard]] PosednessMargin posedness_margin(const Constants& constants, const Fields& fields);

/// One sentence for a summary.
[[nodiscard]] std::string sentence_of(const PosednessMargin& margin, const core::Grid& grid);

}  // namespace polybed::tfm
