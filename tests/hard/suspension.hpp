// A run of particles in a fluid as a trial treats it: the product's, asked as a textbook's is.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "hard/textbook.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::hard {

/// A closed box of equal cells, m. \param every  steps of the particles to one of the fluid
[[nodiscard]] core::Scene scene_of(double diameter, double density, const scenes::Liquid& fluid, double cell,
                                   std::array<int, 3> cells, int every);

/// A run of the trial's treatment; both take steps of `dt`, s.
[[nodiscard]] std::unique_ptr<TextbookSuspension> begin_suspension(const Trial& trial, core::Scene scene,
                                                                   const std::vector<scenes::Bead>& beads, double dt);

}  // namespace polybed::hard
