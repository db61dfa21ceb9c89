#include "multiscale/effects/choice.hpp"

#include <utility>

#include "multiscale/particle_requirements.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/scene_rules.hpp"
#include "relevance/drag_file.hpp"
#include "relevance/drag_law.hpp"

namespace polybed::multiscale {

relevance::Choice choose(const core::Scene& scene) { return relevance::choose(scene, menu()); }

core::Scene with_choice(core::Scene scene) { return relevance::with_choice(std::move(scene), menu()); }

core::Scene read_chosen_case(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  core::Scene chosen = with_choice(read_case(path, overrides));
  if (!chosen.chooser.chosen.empty()) core::refuse(scene_rules(), chosen);  // what is chosen beside what is given
  choose_stiffness(chosen);
  if (const auto file = relevance::drag_file(core::law_of(chosen, "drag")))
    chosen.drag_record = relevance::record_of(*file, relevance::read_drag_file(*file));
  return chosen;
}

}  // namespace polybed::multiscale
