// Cells out of bounds: their fluxes are of first order for twenty steps, and a resumed run does the same.
#include "tfm/first_order_fallback.hpp"

#include <gtest/gtest.h>

#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

using tfm::FirstOrderFallback;

/// 5 x 8 cells, walls all round but for the inlet and the outlet, one species.
struct SmallBed {
  core::Timers timers;
  core::Scene scene;
  SmallBed() : scene(uniform_bed(1e-3, 2500, 1000, 1e-3, 0.5, 8, 0.04)) {
    scene.column.sides = core::Boundary::wall;
    scene.column.size[0] = 0.025;
    scene.column.cells[0] = 5;
    scene.effects["solids_stress"] = "frictional";
    scene.tfm.max_packing = 0.62;
  }
};

TEST(FirstOrderFallback, FlagsTheFacesOfACellOutOfBoundsForTwentySteps) {
  SmallBed bed;
  const tfm::Model model(bed.scene, bed.timers);
  const core::Grid& grid = model.constants().grid;
  const tfm::StateLayout layout(grid, 1, false);
  FirstOrderFallback fallback(model.constants(), model.boundaries(), 1e-5);
  std::vector<double> y(layout.size(), 0.0);
  const auto see = [&] { fallback.see(layout, y, model.effects().solids_stress.get()); };
  y[2 + 5 * 3] = -1e-4;  // at the bound, 10 atol
  y[0] = 0.6209;         // below phi_max + 1e-3
  see();
  EXPECT_TRUE(fallback.steps_left().empty());
  y[2 + 5 * 3] = -1.01e-4;
  y[0] = 0.6211;
  see();
  EXPECT_EQ(fallback.count(), 2u);
  // A cell in the corner has two walls: one face on each axis. The other has two on each.
  EXPECT_EQ(fallback.faces()[0], (std::vector<core::Index>{grid.index(1, 0), grid.index(2, 3), grid.index(3, 3)}));
  EXPECT_EQ(fallback.faces()[1], (std::vector<core::Index>{grid.index(0, 1), grid.index(2, 3), grid.index(2, 4)}));
  y[0] = y[2 + 5 * 3] = 0.1;
  for (int n = 0; n < FirstOrderFallback::steps - 1; ++n) see();
  EXPECT_EQ(fallback.faces()[0].size(), 3u) << "the twentieth step still has them";
  see();
  EXPECT_TRUE(fallback.steps_left().empty());
  EXPECT_TRUE(fallback.faces()[0].empty());
  EXPECT_EQ(fallback.count(), 2u);
}

// The bound is that of the cell's own composition: a mixture packs denser than either of its species.
TEST(FirstOrderFallback, AsksForThePackingOfTheCellsOwnComposition) {
  core::Scene scene = scenes::binary_bed(4, 10, 0.012, 0.03);
  scene.tfm.max_packing = core::PackingRule::yu_standish;
  for (core::Species& species : scene.species) species.max_packing = 0.62;
  core::Timers timers;
  const tfm::Model model(scene, timers);
  const tfm::StressEffect& stress = *model.effects().solids_stress;
  const std::vector<double> fine{1.0, 0.0};
  EXPECT_DOUBLE_EQ(stress.packing_of(scene.bed.volume_share), stress.max_packing());
  const double mixed = stress.max_packing(), pure = stress.packing_of(fine);
  ASSERT_GT(mixed, pure + 0.01);
  const tfm::StateLayout layout(model.constants().grid, 2, false);
  FirstOrderFallback fallback(model.constants(), model.boundaries(), 1e-5);
  std::vector<double> y(layout.size(), 0.0);
  y[0] = 0.5 * (mixed + pure);  // one species alone, above its own packing and below the mixture's
  for (std::size_t j = 0; j < 2; ++j) y[layout.entries()[j].begin + 5] = scene.bed.volume_share[j] * y[0];
  fallback.see(layout, y, &stress);
  EXPECT_EQ(fallback.count(), 1u);
  EXPECT_EQ(fallback.steps_left()[0], FirstOrderFallback::steps);
}

TEST(FirstOrderFallback, FlaggedFacesTakeTheFractionFromUpwindAndTheOthersStay) {
  SmallBed bed;
  tfm::Model model(bed.scene, bed.timers);
  tfm::Fields fields = model.fields();
  const core::Grid& grid = model.constants().grid;
  for (std::size_t c = 0; c < fields.solids.fraction[0].size(); ++c)
    fields.solids.fraction[0][c] = 1e-6 * double(c * c);
  for (core::Field& u : fields.solids.velocity[0]) std::fill(u.begin(), u.end(), 0.02);
  const tfm::FaceList flagged{{{grid.index(2, 3)}, {grid.index(1, 5)}, {}}};
  core::FaceField limited, upwind, mixed;
  const auto flux = [&](tfm::Scheme scheme, core::FaceField& out, const tfm::FaceList* list) {
    tfm::continuity(model.constants(), model.boundaries(), scheme, 0, fields, list);
    out = fields.solids_flux[0];
  };
  flux(tfm::Scheme::limited, limited, nullptr);
  flux(tfm::Scheme::upwind, upwind, nullptr);
  flux(tfm::Scheme::limited, mixed, &flagged);
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t f = 0; f < mixed[a].size(); ++f)
      EXPECT_EQ(mixed[a][f], core::Index(f) == flagged[a].front() ? upwind[a][f] : limited[a][f]);
  EXPECT_NE(limited[0][std::size_t(flagged[0][0])], upwind[0][std::size_t(flagged[0][0])]);
}

/// An unsteady bed that starts with a fraction of -0.005 in one cell, ten times the bound at rtol 1e-3 (explicit: 5).
core::Scene undershot(const char* integrator) {
  core::Scene scene = binary_bed(6, 30, 0.018, 0.09);
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
  scene.tfm.rtol = 1e-3;
  return scene;
}

void undershoot(tfm::Model& model) {
  make_uneven(model, [](int i, int j, int) { return i == 3 && j == 5 ? -0.016 : 1.0; });
}

class Fallback : public testing::TestWithParam<const char*> {};

TEST_P(Fallback, ActsInARunThatStartsOutOfBoundsAndEnds) {
  core::Timers timers;
  tfm::Model model(undershot(GetParam()), timers);
  undershoot(model);
  EXPECT_EQ(model.work().first_order_cells, 0u);
  model.step(0.05);
  EXPECT_GE(model.work().first_order_cells, 1u);
  EXPECT_EQ(model.checkpoint().arrays.count("first_order_steps_left"), 1u);
  model.show(model.time());
  const std::vector<double> before = measures::species_volumes(model.constants().grid, model.fields().solids);
  advance(model, 0.5);
  const std::vector<double> after = measures::species_volumes(model.constants().grid, model.fields().solids);
  record("cells flagged", double(model.work().first_order_cells));
  EXPECT_EQ(model.checkpoint().arrays.count("first_order_steps_left"), 0u) << "still out of bounds after half a second";
  for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(after[j] / before[j], 1, 1e-12);
}

// The flags go with the checkpoint: without them the resumed run would take its first steps with other fluxes.
TEST_P(Fallback, IsResumedToTheBit) {
  core::Timers timers;
  tfm::Model through(undershot(GetParam()), timers), resumed(undershot(GetParam()), timers),
      forgetful(undershot(GetParam()), timers);
  undershoot(through);
  for (int n = 0; n < 8; ++n) through.step(1.0);
  through.restart();
  core::Checkpoint middle = through.checkpoint();
  resumed.resume(middle);
  ASSERT_EQ(middle.arrays.erase("first_order_steps_left"), 1u);
  forgetful.resume(middle);
  for (tfm::Model* model : {&through, &resumed, &forgetful}) {
    for (int n = 0; n < 30; ++n) model->step(1.0);
    model->restart();
  }
  EXPECT_EQ(through.checkpoint(), resumed.checkpoint());
  EXPECT_NE(through.checkpoint().arrays.at("state"), forgetful.checkpoint().arrays.at("state"));
}

INSTANTIATE_TEST_SUITE_P(Integrators, Fallback, testing::Values("explicit", "implicit"));

// Where every flux is of first order there is nothing to fall back to, and nothing is kept.
TEST(FirstOrderFallback, IsAbsentWithUpwindFluxes) {
  core::Scene scene = undershot("explicit");
  scene.tfm.flux = core::FractionFlux::upwind;
  core::Timers timers;
  tfm::Model model(scene, timers);
  undershoot(model);
  model.step(0.05);
  EXPECT_EQ(model.work().first_order_cells, 0u);
}

}  // namespace
}  // namespace polybed::scenes
