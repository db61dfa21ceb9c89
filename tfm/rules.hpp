// What the two-fluid model asks of a scene.
#pragma once

#include <string>
#include <vector>

#include "core/case/rule.hpp"
#include "core/case/scene.hpp"

namespace polybed::tfm {

/// What the keys of [tfm] require, whatever effects there are.
[[nodiscard]] std::vector<core::Rule> key_rules();

/// Of the solids at the start: a run stops where they lie too far above the maximum packing.
[[nodiscard]] std::vector<core::Rule> start_rules();

/// What is wrong with a relative tolerance of implicit steps; empty where nothing is.
[[nodiscard]] std::string wrong_with_implicit_tolerance(double rtol);

/// What this model alone asks of a scene: each rule names what is for the DEM only.
[[nodiscard]] const std::vector<core::Rule>& model_rules();

/// What in a scene is for the DEM only, one message each that names the key; empty: the two-fluid model can run it.
[[nodiscard]] std::vector<std::string> only_for_particles(const core::Scene& scene);

/// Throws core::CaseError with all of these messages.
void refuse_particle_scene(const core::Scene& scene);

}  // namespace polybed::tfm
