// The table of reasons, for people and for programs.
#pragma once

#include <string>

#include "core/case/scene.hpp"
#include "core/output/json.hpp"
#include "relevance/choice.hpp"

namespace polybed::multiscale {

/// The lines to put into the case with their reasons, what is left out, and the effects that the case has or should
/// have, with a mark where it should change: at most 100 columns wide, one screen.
/// \param details  every effect with its reason instead
[[nodiscard]] std::string effects_table(const core::Scene& scene, const relevance::Choice& choice, bool details);

/// The members "effects", "neglected_sum" and what belongs to them, into an open object.
void write_effects(core::Json& json, const core::Scene& scene, const relevance::Choice& choice);

}  // namespace polybed::multiscale
