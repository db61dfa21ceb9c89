// What a scene cannot be, and what it probably is not meant to be, by the laws of both models.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/case/rule.hpp"
#include "core/case/scene.hpp"
#include "core/output/json.hpp"

namespace polybed::multiscale {

/// All that a scene must satisfy beyond its single keys, whichever model runs it: what effects of both models need and
/// exclude, the properties of the fluid, a bed no denser than spheres pack.
[[nodiscard]] const std::vector<core::Rule>& scene_rules();

/// Solids fraction of the bed's mixture after Yu and Standish where spheres of one size pack to `of_one_size`, or to
/// their max_packing if that is more. The shares must be known.
[[nodiscard]] double packing_of_sizes(const core::Scene& scene, double of_one_size);

/// What each model requires beyond that.
[[nodiscard]] const core::ModelRules& rules_of_tfm();
[[nodiscard]] const core::ModelRules& rules_of_dem();

/// The models that are to run a case, or of which one is; none: the case is run by no model.
using Models = std::vector<const core::ModelRules*>;
[[nodiscard]] inline Models either_model() { return {&rules_of_tfm(), &rules_of_dem()}; }

/// What keeps a scene from each model, by its command: {"tfm": [...], "dem": [...]}.
[[nodiscard]] core::Json refusals_of(const core::Scene& scene);

/// Throws core::CaseError with all that core::Rulebook::refusals() tells of a scene.
void refuse(const core::Scene& scene, const Models& models);

/// A case with all that is wrong with it reported at once: core::read_case with the roles, the classes and the rules of
/// this program.
[[nodiscard]] core::Scene read_case(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                                    const Models& models);

/// The same, with what it leaves to the chooser resolved.
[[nodiscard]] core::Scene read_chosen_case(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                                           const Models& models);

}  // namespace polybed::multiscale
