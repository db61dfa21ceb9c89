// How far solids lie above the packing that they can have, whether a stress limits it or none.
#pragma once

#include <cstddef>
#include <span>

#include "tfm/effects.hpp"
#include "tfm/state_layout.hpp"

namespace polybed::tfm {

constexpr std::size_t most_species = 15;  ///< as the case file allows

/// What an owned cell holds.
struct CellSolids {
  double least;          ///< the smallest of its fractions
  double above_packing;  ///< phi less the greatest that its composition can have
};

/// From a state. The greatest fraction is what the stress allows; without one, that of spheres of these sizes each in
/// a crystal, mixed after Yu and Standish. \param cell  in the order of a fraction in the state  \param stress  may be null
[[nodiscard]] CellSolids solids_of(const Constants& constants, const StateLayout& layout, std::span<const double> y,
                                   std::size_t cell, const StressEffect* stress);

/// Above this no bed is shown any more: ten times what a stress that yields may leave (invariant V2).
constexpr double most_above_packing = 0.01;

/// How far phi lies above the greatest that it can have, in the worst cell of the block; 0 if nowhere.
[[nodiscard]] double packing_above(const Constants& constants, const Fields& fields, const StressEffect* stress);

/// Throws core::ConservationError that names time, cell and remedy if solids lie further above the packing than
/// most_above_packing. Collective.
void require_packing(const Constants& constants, const StateLayout& layout, std::span<const double> y, double t,
                     const StressEffect* stress);

}  // namespace polybed::tfm
