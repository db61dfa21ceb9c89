// Roles that contradict each other, told with the lines of both.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/scene.hpp"

namespace polybed::multiscale {

/// Two lines for each pair of roles of a scene that cannot both be, whatever the model; empty if there is none.
/// \param text  of the case file, for the lines  \param name  of the file
[[nodiscard]] std::vector<core::CaseProblem> role_conflicts(const core::Scene& scene, const std::string& text,
                                                            const std::string& name);

/// Throws them, if there are any.
void refuse_role_conflicts(const core::Scene& scene, const std::filesystem::path& path);

}  // namespace polybed::multiscale
