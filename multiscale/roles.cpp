#include "multiscale/roles.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "closures/size_classes.hpp"
#include "dem/effects/maker.hpp"
#include "multiscale/scene_rules.hpp"
#include "tfm/effects/maker.hpp"

namespace polybed::multiscale {

const relevance::Menu& menu() {
  static const relevance::Menu all = [] {
    relevance::Menu both;
    for (const tfm::Maker* one : tfm::effects()) relevance::add(both, *one->effect, "tfm", one->slot);
    // One case file describes a scene for both models, so it can define contacts.
    for (const dem::Maker* one : dem::effects()) relevance::add(both, *one->effect, "dem", one->slot);
    return both;
  }();
  return all;
}

const relevance::MenuEntry* find_entry(const std::string& role) {
  const auto found = std::find_if(menu().begin(), menu().end(),
                                  [&](const relevance::MenuEntry& entry) { return entry.effect->role == role; });
  return found == menu().end() ? nullptr : &*found;
}

bool can_be_added(const relevance::MenuEntry& entry, const std::string& model) {
  const auto is_force = [&](const dem::Maker* one) {
    return one->effect == entry.effect && std::holds_alternative<dem::MakeForce>(one->make);
  };
  return std::any_of(dem::effects().begin(), dem::effects().end(), is_force) &&
         entry.models.find(model) != std::string::npos;
}

std::vector<core::Role> all_roles() { return relevance::roles_of(menu()); }

std::vector<std::string> models_of(const core::Scene& scene) {
  if (!rules_of_tfm().problems(scene).empty()) return {"dem"};
  if (!rules_of_dem().problems(scene).empty()) return {"tfm"};
  const bool touching = core::acts(scene, "contact"), pressing = core::acts(scene, "solids_stress");
  if (touching != pressing) return {touching ? "dem" : "tfm"};
  return {"tfm", "dem"};
}

relevance::Choice choose(const core::Scene& scene) { return relevance::choose(scene, menu()); }

core::Scene with_choice(core::Scene scene) { return relevance::with_choice(std::move(scene), menu()); }

std::vector<std::pair<double, double>> size_classes(const core::SizeDistribution& given) {
  std::vector<closures::SizeClass> classes;
  if (given.kind == core::SizeLaw::sieves) {
    std::vector<double> opening, share;
    for (const auto& [d, x] : given.sieves) {
      opening.push_back(d);
      share.push_back(x);
    }
    classes = closures::sieve_classes(opening, share, given.classes);
  } else {
    const double s = given.deviation.value();
    classes = closures::lognormal_classes(given.median ? *given.median : given.mean.value() * std::exp(-0.5 * s * s), s,
                                          given.classes);
  }
  std::vector<std::pair<double, double>> result;
  for (const closures::SizeClass& c : classes) result.emplace_back(c.diameter, c.share);
  return result;
}

}  // namespace polybed::multiscale
