// Valid names in a case file from the models: all roles in [effects], and size distributions.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/case/registry.hpp"
#include "core/case/size_classes.hpp"
#include "relevance/choice.hpp"
#include "relevance/effect.hpp"

namespace polybed::multiscale {

/// The effects of the continuum model, then the particle model's own.
[[nodiscard]] const relevance::Menu& menu();

/// The entry of a role; null if there is none.
[[nodiscard]] const relevance::MenuEntry* find_entry(const std::string& role);

/// Whether a run with a model can continue from a checkpoint without the effect: only for a force on particles besides
/// drag. The model rejects a force with memory of the past.
[[nodiscard]] bool can_be_added(const relevance::MenuEntry& entry, const std::string& model);

/// Their roles.
[[nodiscard]] std::vector<core::Role> all_roles();

/// The models that suit a case, "tfm", "dem" or both: a case that only one can run is for that one, and so is a case
/// whose solids have a stress but no contacts, or the other way round.
[[nodiscard]] std::vector<std::string> models_of(const core::Scene& scene);

/// relevance::choose and relevance::with_choice for the whole menu.
[[nodiscard]] relevance::Choice choose(const core::Scene& scene);
[[nodiscard]] core::Scene with_choice(core::Scene scene);

/// Converts a size distribution to classes by its moments, closures/size_classes.hpp.
[[nodiscard]] std::vector<std::pair<double, double>> size_classes(const core::SizeDistribution& distribution);

}  // namespace polybed::multiscale
