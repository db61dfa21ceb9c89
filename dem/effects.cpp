#include "dem/effects.hpp"

#include "core/error.hpp"
#include "dem/effects/maker.hpp"
#include "dem/rules.hpp"
#include "relevance/effect_rules.hpp"

namespace polybed::dem {

namespace {

relevance::Menu menu_of(const std::vector<const Maker*>& list) {
  relevance::Menu menu;
  for (const Maker* one : list) relevance::add(menu, *one->effect, "dem", one->slot);
  return menu;
}

}  // namespace

std::vector<core::Role> roles() { return relevance::roles_of(menu_of(effects())); }

std::vector<core::Rule> rules_of_keys(const std::vector<const Maker*>& list) {
  std::vector<core::Rule> all;
  for (const Maker* one : list) all.insert(all.end(), one->rules.begin(), one->rules.end());
  return all;
}

std::vector<core::Rule> rules(const std::vector<const Maker*>& list) {
  return relevance::joined({relevance::rules_of(menu_of(list)), rules_of_keys(list)});
}

double longest_step(const core::Scene& scene, const Materials& materials) {
  constexpr double shape = 3;  // a contact lasts 2.9 times its greatest overlap over its speed
  double radius = 0;
  for (const PairMaterial& pair : materials.kinds()) radius = std::max(radius, pair.least_radius);
  return shape * scene.dem.max_overlap * 2 * radius / scene.dem.steps_per_contact;
}

PairLaws make_pair_laws(const core::Scene& scene, const Materials& materials, const std::vector<const Maker*>& list,
                        double resolved_gap) {
  core::refuse(rules(list), scene);
  PairLaws laws;
  std::function<std::unique_ptr<NormalLaw>(const MakeNormal&)> around_normal;
  for_each_called<MakePair>(list, scene, [&](MakePair make, const std::string& law) {
    make({scene, materials, law, laws, around_normal, resolved_gap});
  });
  if (!laws.normal) throw core::StartError(contact_rule().problems(scene));
  return laws;
}

}  // namespace polybed::dem
