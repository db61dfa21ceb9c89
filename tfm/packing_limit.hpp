// How far solids lie above the packing that they can have.
#pragma once

#include <span>

#include "tfm/effects.hpp"
#include "tfm/state_layout.hpp"

namespace polybed::tfm {

/// What an owned cell holds.
struct CellSolids {
  double least;          ///< the smallest of its fractions
  double above_packing;  ///< phi less the maximum packing of the cell's composition; 0 without a stress
};

/// From a state. \param cell  in the order of a fraction in the state  \param stress  may be null
[[nodiscard]] CellSolids solids_of(const Constants& constants, const StateLayout& layout, std::span<const double> y,
                                   std::size_t cell, const StressEffect* stress);

/// Above this no bed is shown any more: ten times what a stress that yields may leave (invariant V2).
constexpr double most_above_packing = 0.01;

/// Throws core::ConservationError that names time, cell and what holds unlike solids together if solids lie further
/// above the packing than that. Collective.
void require_packing(const Constants& constants, const StateLayout& layout, std::span<const double> y, double t,
                     const StressEffect& stress);

}  // namespace polybed::tfm
