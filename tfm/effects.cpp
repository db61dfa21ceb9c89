#include "tfm/effects.hpp"

#include <utility>

#include "core/case/scene.hpp"
#include "tfm/effects/maker.hpp"
#include "tfm/rules.hpp"

namespace polybed::tfm {

namespace {

relevance::Menu menu_of(const std::vector<const Maker*>& list) {
  relevance::Menu menu;
  for (const Maker* one : list) relevance::add(menu, *one->effect, "tfm", one->slot);
  return menu;
}

}  // namespace

std::vector<core::Role> roles() { return relevance::roles_of(menu_of(effects())); }

std::vector<core::Rule> rules(const std::vector<const Maker*>& list) {
  std::vector<core::Rule> all = relevance::rules_of(menu_of(list));
  for (core::Rule& rule : key_rules()) all.push_back(std::move(rule));
  return all;
}

Effects make_effects(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                     Fields& fields, const std::vector<const Maker*>& list) {
  core::refuse(rules(list), scene);
  Effects made;
  for (const Maker* one : list) {
    const std::string law = core::law_of(scene, one->effect->role);
    if (one->make != nullptr && !core::is_off(law)) one->make({scene, constants, boundaries, law, fields, made});
  }
  if (scene.tfm.solids_wall == core::SolidsWall::johnson_jackson)
    made.solids_wall = johnson_jackson_wall(scene, constants, boundaries, fields);
  if (scene.fluid.compressible()) {
    const double density = constants.fluid.density;
    made.compressible = std::make_unique<fluid::Compressible>(constants.grid, boundaries,
                                                              fluid::equation_of_state(scene.fluid, density),
                                                              scene.fluid.outlet_pressure, density, constants.gravity);
    made.compressible->make_fields(fields.fluid);
  }
  return made;
}

}  // namespace polybed::tfm
