// What a scene cannot be, and what it probably is not meant to be, by the laws of both models.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/case/rule.hpp"
#include "core/case/scene.hpp"

namespace polybed::multiscale {

/// All that a scene must satisfy beyond its single keys: what effects need and exclude, what the models ask of it, the
/// properties of the fluid, a bed no denser than spheres pack.
[[nodiscard]] const std::vector<core::Rule>& scene_rules();

/// One line for each thing that can be computed and is rarely meant: an inlet that draws fluid out, a species that
/// floats. \param scene  that keeps the rules
[[nodiscard]] std::vector<std::string> scene_warnings(const core::Scene& scene);

/// A case with all that is wrong with it reported at once: core::read_case with the roles, the classes and the rules of
/// this program.
[[nodiscard]] core::Scene read_case(const std::filesystem::path& path, const std::vector<std::string>& overrides);

/// The same, with what it leaves to the chooser resolved.
[[nodiscard]] core::Scene read_chosen_case(const std::filesystem::path& path,
                                           const std::vector<std::string>& overrides);

}  // namespace polybed::multiscale
