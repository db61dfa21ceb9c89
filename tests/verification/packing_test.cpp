// The maximum packing of a mixture in each cell: mixed small and large particles pack denser than layers of each.
#include <gtest/gtest.h>

#include "closures/stress_frictional.hpp"
#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

/// Two sizes of one density, at rest in water: a column that is mixed, or layered with the large ones below.
core::Scene at_rest(core::StartKind start, core::MaxPacking packing) {
  core::Scene scene = uniform_bed(2e-3, 2500, 998.207, 1.00157e-3, 0.60, 40, 0.2);
  scene.species.push_back(scene.species[0]);
  scene.species[0].name = "large";
  scene.species[1].name = "small";
  scene.species[1].diameter = 0.8e-3;
  for (core::Species& species : scene.species) species.max_packing = 0.62;
  scene.bed.volume_share = {0.5, 0.5};
  scene.bed.static_height = 0.1;
  scene.bed.start = {start};
  scene.column.closed = true;
  scene.effects["solids_stress"] = "frictional";
  scene.tfm.max_packing = packing;
  return scene;
}

// 0.67243 is the packing of this mixture after Yu and Standish, 0.67975 after Fedors and Landel (by hand, see
// unit/closures). With it, p_f at the bottom is the weight above: 0.06 m of solids, (2500 - 998.207) 9.81 0.06 = 884
// Pa, less what is below the centre of the second cell and the loose top cell, a cell and a half of 44 Pa. The slope of
// p_f there is 7e4 Pa, so 0.62 in place of the mixture's packing would give several times that.
TEST(MixturePacking, AMixedBedSettlesDenserThanItsSizes) {
  for (const auto& [law, packing] :
       {std::pair{core::PackingRule::yu_standish, 0.67243}, {core::PackingRule::fedors_landel, 0.67975}}) {
    core::Timers timers;
    tfm::Model model(at_rest(core::StartKind::settled, law), timers);
    model.show(0);
    const double phi = model.fields().solids_fraction[std::size_t(model.constants().grid.index(0, 1))];
    closures::FrictionalLaw friction;
    EXPECT_NEAR(friction.at(phi, packing).pressure, 884 - 1.5 * 44, 44) << core::name_of(law);
    EXPECT_GT(friction.at(phi, 0.62).pressure, 5 * 884) << core::name_of(law);
    EXPECT_NEAR(model.effects().solids_stress->max_packing(), packing, 5e-6) << core::name_of(law);
  }
}

// Layers of one size each keep below their own 0.62, although mixed they would pack to 0.67.
TEST(MixturePacking, LayersKeepToThePackingOfTheirSize) {
  core::Scene scene = at_rest(core::StartKind::layered, core::PackingRule::yu_standish);
  scene.tfm.integrator = core::TfmIntegrator::implicit_steps;
  core::Timers timers;
  tfm::Model model(scene, timers);
  advance(model, 1.0);
  const auto phi = [&](int j) {
    return model.fields().solids_fraction[std::size_t(model.constants().grid.index(0, j))];
  };
  EXPECT_LT(phi(2), 0.62);
  EXPECT_LT(phi(15), 0.62);
  EXPECT_LT(model.effects().solids_stress->packing_above(model.fields()), 1e-3);
}

}  // namespace
}  // namespace polybed::scenes
