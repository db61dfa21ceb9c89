// What the particle model asks of a scene.
#pragma once

#include <string>
#include <vector>

#include "core/case/rule.hpp"
#include "core/case/scene.hpp"

namespace polybed::dem {

/// What the keys of [dem] require, of the effects that read them and whatever effects there are.
[[nodiscard]] std::vector<core::Rule> key_rules();

/// What this model alone asks of a scene.
[[nodiscard]] const std::vector<core::Rule>& model_rules();

/// What keeps a scene from the particle model, each with its key; empty if nothing does.
[[nodiscard]] std::vector<std::string> only_for_continuum(const core::Scene& scene);

/// Throws core::CaseError with all of it.
void refuse_continuum_scene(const core::Scene& scene);

}  // namespace polybed::dem
