#include "multiscale/effects/choice.hpp"

#include <algorithm>

#include "closures/relevance.hpp"
#include "multiscale/effects/situation.hpp"
#include "multiscale/effects/weigh.hpp"
#include "multiscale/particle_requirements.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/scene_rules.hpp"

namespace polybed::multiscale {

namespace {

using State = EffectRow::State;

EffectRow* find(std::vector<EffectRow>& rows, const std::string& effect) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const EffectRow& row) { return row.effect == effect; });
  return found == rows.end() ? nullptr : &*found;
}

/// What contradicts what: a spin needs friction, and what is held does not accelerate.
void apply_logic(const core::Scene& scene, std::vector<EffectRow>& rows) {
  EffectRow *magnus = find(rows, "magnus"), *contact = find(rows, "contact"), *history = find(rows, "history");
  const std::string given = core::law_of(scene, "contact");
  const bool free = given == core::automatic || !scene.effects.contains("contact");
  if (magnus != nullptr && (free ? contact->model == "hertz" : given == "hertz")) {
    magnus->value.reset();
    magnus->up_to.reset();
    magnus->neglected = 0;
    magnus->reason = "without friction nothing rotates";
  }
  if (history != nullptr && scene.dem.held) {
    history->value.reset();
    history->neglected = 0;
    history->reason = "dem.held: particles do not accelerate";
  }
}

std::vector<EffectRow> weigh(const core::Scene& scene, const Survey& of_scene) {
  std::vector<EffectRow> rows = weigh_phases(scene, of_scene);
  for (auto* part : {&weigh_forces, &weigh_conditions})
    for (EffectRow& row : part(scene, of_scene)) rows.push_back(std::move(row));
  apply_logic(scene, rows);
  return rows;
}

/// The roles that the case decides itself. What it does not name is off.
DecisionRule rule_of(const core::Scene& scene, bool free) {
  DecisionRule rule{scene.chooser.tolerance, scene.chooser.purpose == core::Purpose::transient, {}, {}};
  if (free) return rule;
  for (const core::Role& role : all_roles()) {
    const std::string law = core::law_of(scene, role.name);
    if (law != core::automatic) (law == "none" ? rule.off : rule.on).insert(role.name);
  }
  return rule;
}

}  // namespace

bool has_auto(const core::Scene& scene) {
  return std::any_of(scene.effects.begin(), scene.effects.end(),
                     [](const auto& entry) { return entry.second == core::automatic; });
}

Choice choose(const core::Scene& scene) {
  Choice choice;
  choice.tolerance = scene.chooser.tolerance;
  const Survey of_scene = survey(scene);
  choice.surfaces = surfaces_of(scene, of_scene);
  choice.rows = weigh(scene, of_scene);
  choice.of_case = choice.rows;
  decide(choice.rows, rule_of(scene, !has_auto(scene)));
  choice.neglected_sum = neglected_sum(choice.rows);
  choice.sum_up_to = neglected_up_to(choice.rows);
  decide(choice.of_case, rule_of(scene, false));
  choice.case_sum = neglected_sum(choice.of_case);
  return choice;
}

core::Scene with_choice(core::Scene scene) {
  if (!has_auto(scene)) return scene;
  const Choice choice = choose(scene);
  for (auto entry = scene.effects.begin(); entry != scene.effects.end();) {
    if (entry->second != core::automatic) {
      ++entry;
      continue;
    }
    scene.chooser.chosen.push_back(entry->first);
    const auto row = std::find_if(choice.rows.begin(), choice.rows.end(),
                                  [&](const EffectRow& r) { return r.effect == entry->first; });
    const bool on = row != choice.rows.end() && row->state == State::on && row->not_built.empty();
    if (on && row->model == "van_der_waals") {
      scene.dem.hamaker_constant = choice.surfaces.hamaker;
      scene.dem.cohesion_gap = closures::relevance_contact_gap;
      scene.dem.asperity_radius = 0.5 * choice.surfaces.roughness;
    }
    if (on) entry->second = row->model;
    entry = on ? std::next(entry) : scene.effects.erase(entry);
  }
  if (scene.chooser.monitor == core::MonitorMode::automatic) scene.chooser.monitor = core::MonitorMode::warn;
  return scene;
}

core::Scene read_chosen_case(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  core::Scene chosen = with_choice(read_case(path, overrides));
  choose_stiffness(chosen);
  return chosen;
}

}  // namespace polybed::multiscale
