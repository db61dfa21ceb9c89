// What the two-fluid model asks of a scene.
#pragma once

#include <string>
#include <vector>

#include "core/case/rule.hpp"
#include "core/case/scene.hpp"

namespace polybed::tfm {

/// What the keys of [tfm] require, whatever effects there are.
[[nodiscard]] std::vector<core::Rule> key_rules();

/// Of these what the maximum packing and tables of the stress require.
[[nodiscard]] std::vector<core::Rule> stress_rules();

/// What the bed at its start and the integrator require: a model that is made from a scene which breaks one of these
/// throws core::StartError.
[[nodiscard]] std::vector<core::Rule> start_rules();

/// What is wrong with a relative tolerance of implicit steps; empty where nothing is.
[[nodiscard]] std::string wrong_with_implicit_tolerance(double rtol);

/// What this model alone asks of a scene: each rule names what is for the DEM only.
[[nodiscard]] const std::vector<core::Rule>& model_rules();

/// The scene; throws core::CaseError with the messages of all rules that it breaks.
[[nodiscard]] const core::Scene& continuum_scene(const core::Scene& scene);

}  // namespace polybed::tfm
