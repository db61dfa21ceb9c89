// Requirements of the two-fluid model on a scene.
#pragma once

#include <string>
#include <vector>

#include "core/case/rule.hpp"
#include "core/case/scene.hpp"

namespace polybed::tfm {

/// Requirements of the keys in [tfm], whatever effects there are.
[[nodiscard]] std::vector<core::Rule> key_rules();

/// The part of them for the maximum packing and tables of the stress.
[[nodiscard]] std::vector<core::Rule> stress_rules();

/// Requirements of the initial bed and the integrator. A model throws core::StartError for a scene that breaks one of
/// these.
[[nodiscard]] std::vector<core::Rule> start_rules();

/// The problem with a relative tolerance for implicit steps; empty if there is none.
[[nodiscard]] std::string wrong_with_implicit_tolerance(double rtol);

/// Requirements of this model alone on a scene: each rule names a feature that only the DEM supports.
[[nodiscard]] const std::vector<core::Rule>& model_rules();

/// Returns the scene; throws core::CaseError with the messages of all rules that it breaks.
[[nodiscard]] const core::Scene& continuum_scene(const core::Scene& scene);

}  // namespace polybed::tfm
