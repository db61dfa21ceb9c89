#include "tfm/effects.hpp"

#include "core/case/laws.hpp"
#include "tfm/effects/maker.hpp"
#include "tfm/effects/solids_wall_johnson_jackson.hpp"

namespace polybed::tfm {

Effects make_effects(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                     Fields& fields, const std::vector<const Maker*>& list) {
  core::refuse(rules(list), scene);
  Effects made;
  for (const Maker* one : list) {
    const std::string law = core::law_of(scene, one->effect->role);
    if (one->make != nullptr && !core::is_off(law)) one->make({scene, constants, boundaries, law, fields, made});
  }
  if (scene.tfm.solids_wall == core::SolidsWall::johnson_jackson)
    made.solids_wall = std::make_unique<JohnsonJacksonWall>(scene, constants, boundaries, fields);
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
