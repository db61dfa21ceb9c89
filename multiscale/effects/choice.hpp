// What a scene calls for, of all effects that the models have.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "relevance/choice.hpp"

namespace polybed::multiscale {

/// relevance::choose and relevance::with_choice of the whole menu.
[[nodiscard]] relevance::Choice choose(const core::Scene& scene);
[[nodiscard]] core::Scene with_choice(core::Scene scene);

/// Reads a case and resolves what it leaves to the chooser.
[[nodiscard]] core::Scene read_chosen_case(const std::filesystem::path& path,
                                           const std::vector<std::string>& overrides);

}  // namespace polybed::multiscale
