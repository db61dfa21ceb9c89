// Errors and probable mistakes in a scene, from the laws of both models.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/case/rule.hpp"
#include "core/case/scene.hpp"
#include "core/output/json.hpp"

namespace polybed::multiscale {

/// Requirements on a scene beyond its single keys, for any model: requirements and exclusions of both models' effects,
/// the properties of the fluid, a bed no denser than spheres can pack.
[[nodiscard]] const std::vector<core::Rule>& scene_rules();

/// Solids fraction of the bed's mixture after Yu and Standish, where spheres of one size pack to `of_one_size`, or to
/// their max_packing if that is more. The shares must be known.
[[nodiscard]] double packing_of_sizes(const core::Scene& scene, double of_one_size);

/// Further requirements of each model.
[[nodiscard]] const core::ModelRules& rules_of_tfm();
[[nodiscard]] const core::ModelRules& rules_of_dem();

/// The models that are to run a case, or alternatives; empty: no model runs it.
using Models = std::vector<const core::ModelRules*>;
[[nodiscard]] inline Models either_model() { return {&rules_of_tfm(), &rules_of_dem()}; }

/// Problems of a scene for each model, by its command: {"tfm": [...], "dem": [...]}.
[[nodiscard]] core::Json refusals_of(const core::Scene& scene);

/// Throws core::CaseError with all of core::Rulebook::refusals() for a scene.
void refuse(const core::Scene& scene, const Models& models);

/// Reads a case and reports all its problems at once: core::read_case with the roles, the classes and the rules of this
/// program.
[[nodiscard]] core::Scene read_case(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                                    const Models& models);

/// The same, with the chooser's roles resolved.
[[nodiscard]] core::Scene read_chosen_case(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                                           const Models& models);

}  // namespace polybed::multiscale
