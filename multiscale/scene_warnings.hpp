// What a scene is probably not meant to be, and what that does to the answer.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::multiscale {

/// One line for each thing that can be computed and is rarely meant: an inlet that draws fluid out, a species that
/// floats, a checkpoint to start from that is not there, a bed that hangs, a gas faster than an incompressible one can
/// be,
/// spheres packed more densely than at random. \param scene  that keeps the rules
[[nodiscard]] std::vector<std::string> scene_warnings(const core::Scene& scene);

/// Of the two-fluid model: a grid too coarse for the bed, or finer than its particles.
[[nodiscard]] std::vector<std::string> grid_warnings(const core::Scene& scene);

}  // namespace polybed::multiscale
