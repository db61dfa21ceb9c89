#include "relevance/effect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace polybed::relevance {

std::string two_digits(double value) {
  constexpr double rounds_to_three = 99.5, million = 1e6;
  return std::abs(value) >= rounds_to_three && std::abs(value) < million ? fmt::format("{:.0f}", value)
                                                                         : fmt::format("{:.2g}", value);
}

std::string percent(double share) {
  return share > 0 && share < 1e-5 ? "less than 0.001 %" : two_digits(100 * share) + " %";
}

bool Encountered::certain() const {
  return !(fluid_density * std::sqrt(closures::dot(slip, slip)) * diameter / viscosity > greatest_certain_reynolds);
}

bool Effect::law_has(const std::string& law, const Trait& trait) const {
  const auto is_named = [&](const std::string& name) {
    const std::size_t file = name.find(':');
    return file == std::string::npos ? law == name : law.starts_with(name.substr(0, file + 1));
  };
  return std::any_of(traits.begin(), traits.end(), [&](const LawsWith& one) {
    return one.trait == &trait && std::any_of(one.laws.begin(), one.laws.end(), is_named);
  });
}

Surfaces surfaces_of(const core::Scene& scene, const Survey& survey) {
  const double known = scene.material.hamaker_constant, usual = survey.is_gas || !survey.has_fluid ? 1e-19 : 1e-20;
  return {scene.material.roughness, known > 0 ? known : usual};
}

void add(Menu& menu, const Effect& effect, const std::string& model, const std::string& slot) {
  const auto there =
      std::find_if(menu.begin(), menu.end(), [&](const MenuEntry& e) { return e.effect->role == effect.role; });
  if (there == menu.end())
    menu.push_back({&effect, model, slot});
  else
    there->models += ", " + model;
}

std::vector<core::Role> roles_of(const Menu& menu) {
  std::vector<core::Role> roles;
  for (const auto& [effect, models, slot] : menu)
    roles.push_back({effect->role, models, slot, effect->help, effect->absent, effect->laws, effect->advice});
  return roles;
}

std::vector<core::Rule> rules_of(const Menu& menu, const std::string& models) {
  std::vector<core::Rule> rules;
  for (const MenuEntry& entry : menu)
    if (models.empty() || entry.models == models)
      rules.insert(rules.end(), entry.effect->rules.begin(), entry.effect->rules.end());
  return rules;
}

EffectRow row_of(const MenuEntry& entry) {
  EffectRow row =
      effect_row(entry.effect->role.c_str(), entry.effect->laws.front().name.c_str(), entry.effect->number.c_str());
  row.phrase = entry.effect->phrase;
  row.models = entry.models;
  row.of_acceleration = entry.effect->of_acceleration;
  return row;
}

EffectRow as_force(EffectRow row, const core::Scene& scene) {
  row.threshold = scene.chooser.tolerance;
  row.summed = true;
  row.on_particles = true;
  return row;
}

const EffectRow* find_row(const std::vector<EffectRow>& rows, const std::string& role) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const EffectRow& row) { return row.effect == role; });
  return found == rows.end() ? nullptr : &*found;
}

std::vector<EffectRow> weigh(const core::Scene& scene, const Survey& survey, const Menu& menu) {
  std::vector<EffectRow> rows;
  const Weighing weighing{scene, survey, rows};
  for (const MenuEntry& entry : menu)
    if (auto row = entry.effect->weigh(weighing, row_of(entry))) rows.push_back(std::move(*row));
  for (const MenuEntry& entry : menu) {
    const std::string why = entry.effect->idle ? entry.effect->idle(weighing) : "";
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const EffectRow& r) { return r.effect == entry.effect->role; });
    if (why.empty() || row == rows.end()) continue;
    row->value.reset();
    row->up_to.reset();
    row->neglected = 0;
    row->reason = why;
  }
  for (EffectRow& row : weigh_conditions(scene, survey)) rows.push_back(std::move(row));
  return rows;
}

}  // namespace polybed::relevance
