// The table of reasons, for people and for programs.
#pragma once

#include <string>

#include "core/case/scene.hpp"
#include "core/output/json.hpp"
#include "relevance/choice.hpp"

namespace polybed::multiscale {

/// Lines of the table, and below it what is left out.
[[nodiscard]] std::string effects_table(const core::Scene& scene, const relevance::Choice& choice);

/// The members "effects", "neglected_sum" and what belongs to them, into an open object.
void write_effects(core::Json& json, const core::Scene& scene, const relevance::Choice& choice);

}  // namespace polybed::multiscale
