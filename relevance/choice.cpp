#include "relevance/choice.hpp"

#include <algorithm>

#include "core/case/scene.hpp"
#include "relevance/situation.hpp"

namespace polybed::relevance {

namespace {

/// The roles that the case decides itself. Roles that it does not name are off.
DecisionRule rule_of_case(const core::Scene& scene, const Menu& menu) {
  DecisionRule rule{scene.chooser.tolerance, scene.chooser.purpose == core::Purpose::transient, {}, {}};
  for (const MenuEntry& entry : menu) {
    const std::string law = core::law_of(scene, entry.effect->role);
    if (law != core::automatic) (core::is_off(law) ? rule.off : rule.on).insert(entry.effect->role);
  }
  return rule;
}

/// Whether the rules of an effect admit a scene, with the keys set by its choice: some effects cannot act in a sheared
/// box.
bool may_have(core::Scene scene, const Effect& effect, const std::string& law, const Surfaces& surfaces) {
  if (effect.set_keys) effect.set_keys(scene, surfaces);
  scene.effects[effect.role] = law;
  return core::problems_of(effect.rules, scene).empty();
}

}  // namespace

bool has_auto(const core::Scene& scene) {
  return std::any_of(scene.effects.begin(), scene.effects.end(),
                     [](const auto& entry) { return entry.second == core::automatic; });
}

Choice choose(const core::Scene& scene, const Menu& menu) {
  Choice choice;
  choice.tolerance = scene.chooser.tolerance;
  const Survey of_scene = survey(scene);
  choice.surfaces = surfaces_of(scene, of_scene);
  choice.rows = weigh(scene, of_scene, menu);
  choice.of_case = choice.rows;
  DecisionRule rule = rule_of_case(scene, menu);
  decide(choice.of_case, rule);
  rule.off.clear();
  if (!has_auto(scene)) rule.on.clear();
  decide(choice.rows, rule);
  choice.neglected_sum = neglected_sum(choice.rows);
  choice.sum_up_to = neglected_up_to(choice.rows);
  choice.case_sum = neglected_sum(choice.of_case);
  return choice;
}

core::Scene with_choice(core::Scene scene, const Menu& menu) {
  if (!has_auto(scene)) return scene;
  const Choice choice = choose(scene, menu);
  for (const MenuEntry& entry : menu) {
    const std::string& role = entry.effect->role;
    if (core::law_of(scene, role) != core::automatic) continue;
    scene.chooser.chosen.push_back(role);
    const EffectRow* row = find_row(choice.of_case, role);
    const bool on = row != nullptr && row->state == EffectRow::State::on && row->not_built.empty() &&
                    may_have(scene, *entry.effect, row->model, choice.surfaces);
    if (on && entry.effect->set_keys) entry.effect->set_keys(scene, choice.surfaces);
    on ? void(scene.effects[role] = row->model) : void(scene.effects.erase(role));
  }
  std::sort(scene.chooser.chosen.begin(), scene.chooser.chosen.end());
  if (scene.chooser.monitor == core::MonitorMode::automatic) scene.chooser.monitor = core::MonitorMode::warn;
  return scene;
}

}  // namespace polybed::relevance
