// The bed at the start of a run.
#pragma once

#include "core/case/scene.hpp"
#include "tfm/effects.hpp"

namespace polybed::tfm {

/// Volume of solids per area of the column, m: static height times solids fraction.
[[nodiscard]] double solids_height(const core::Bed& bed);

/// Fills the solids fractions of all owned cells as the case requires: `mixed` (one composition), `layered`
/// (core::start_parts), `settled` (one composition, supported by the solids pressure cell by cell). All velocities and
/// the pressure stay zero. Throws core::CaseError if the column is too low for the bed.
void fill_bed(const core::Scene& scene, const Constants& constants, const StressEffect* stress,
              fluid::Interphase& solids);

}  // namespace polybed::tfm
