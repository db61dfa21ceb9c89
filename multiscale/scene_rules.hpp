// What a scene cannot be, and what it probably is not meant to be, by the laws of both models.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/case/rule.hpp"
#include "core/case/scene.hpp"

namespace polybed::multiscale {

/// Everything in a scene that contradicts itself or lacks a number: roles against roles, what effects need, the
/// properties of the fluid, a bed denser than spheres pack. The rule of the case file.
[[nodiscard]] std::vector<core::SceneFault> scene_faults(const core::Scene& scene);

/// One line for each thing that can be computed and is rarely meant: an inlet that draws fluid out, a species that
/// floats. \param scene  without faults
[[nodiscard]] std::vector<std::string> scene_warnings(const core::Scene& scene);

/// A case with all that is wrong with it reported at once: core::read_case with the roles, the classes and the rule of
/// this program.
[[nodiscard]] core::Scene read_case(const std::filesystem::path& path, const std::vector<std::string>& overrides);

}  // namespace polybed::multiscale
