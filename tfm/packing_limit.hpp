// Excess of solids over their maximum packing, with or without a stress that limits it.
#pragma once

#include <cstddef>
#include <span>

#include "tfm/effects.hpp"
#include "tfm/state_layout.hpp"

namespace polybed::tfm {

constexpr std::size_t most_species = 15;  ///< as the case file allows

/// Solids in an owned cell.
struct CellSolids {
  double least;          ///< smallest fraction of a species
  double above_packing;  ///< phi minus the greatest value for its composition; an upper bound below 0
};

/// The least packing of any composition: mixtures pack at least as densely as one of their species alone.
[[nodiscard]] double least_packing(const Constants& constants, const StressEffect* stress);

/// From a state. The stress sets the greatest fraction; without one it is for spheres of these sizes each in a crystal,
/// mixed after Yu and Standish. \param cell  in the order of a fraction in the state  \param stress  can be null
/// \param least_packing  from above
[[nodiscard]] CellSolids solids_of(const Constants& constants, const StateLayout& layout, std::span<const double> y,
                                   std::size_t cell, const StressEffect* stress, double least_packing);

/// The limit of a real bed: ten times the excess that a yielding stress can leave (invariant V2).
constexpr double most_above_packing = 0.01;

/// Greatest excess of phi over its maximum in a cell of the block; 0 if there is none.
[[nodiscard]] double packing_above(const Constants& constants, const Fields& fields, const StressEffect* stress);

/// Throws core::ConservationError with time, cell and remedy if solids exceed the packing by more than
/// most_above_packing. Collective.
void require_packing(const Constants& constants, const StateLayout& layout, std::span<const double> y, double t,
                     const StressEffect* stress);

}  // namespace polybed::tfm
