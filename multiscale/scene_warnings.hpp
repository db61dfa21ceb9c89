// Probable mistakes in a scene, and their effect on the result.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::multiscale {

/// One line for each setting that can be computed but is rarely intended: an inlet that draws fluid out, a species that
/// floats, a missing checkpoint to start from, a bed that hangs, a gas too fast for an incompressible fluid, spheres
/// packed more densely than at random. \param scene  that satisfies the rules
[[nodiscard]] std::vector<std::string> scene_warnings(const core::Scene& scene);

/// For the two-fluid model: a grid too coarse for the bed, or finer than its particles.
[[nodiscard]] std::vector<std::string> grid_warnings(const core::Scene& scene);

}  // namespace polybed::multiscale
