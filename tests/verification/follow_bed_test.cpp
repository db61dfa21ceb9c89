// The solids' equations asked where solids are, against the whole column: the same bed, whatever rows it rises into.
#include <gtest/gtest.h>

#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

/// A bed of 14 rows in a column of 60 rises by a dozen in half a second: through the eight rows that are asked above
/// it.
core::Scene rising(const std::string& integrator, bool follow) {
  core::Scene scene = binary_bed(6, 60, 0.03, 0.3);
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
  scene.bed.static_height = 0.06;
  scene.inlet.superficial_velocity = {{0.0, 0.08}};
  scene.tfm.pressure_tolerance = 1e-12;
  scene.tfm.follow_bed = follow;
  return scene;
}

struct End {
  core::Field fraction;
  std::vector<double> volume;
  int rows;  ///< of the first to the last with solids
  std::uint64_t evaluations;
};

End run(core::Scene scene) {
  core::Timers timers;
  tfm::Model model(scene, timers);
  advance(model, 0.5);
  const core::Grid& grid = model.constants().grid;
  End end{model.fields().solids.fraction[0], measures::species_volumes(grid, model.fields().solids), 0,
          model.work().right_hand_sides};
  for (int j = 0; j < grid.cells[1]; ++j)
    if (model.fields().solids_fraction[std::size_t(grid.index(0, j))] > 1e-3) end.rows = j + 1;
  return end;
}

class FollowBed : public testing::TestWithParam<std::string> {};

// Fixed steps: what is left out are traces below 1e-12 and velocities of faces without solids, which have eight rows in
// which to become those of the flow. 1e-10 of the fraction and of the volume: this project's goal.
TEST_P(FollowBed, GivesTheWholeColumnsBed) {
  for (const bool forces : {false, true}) {
    core::Scene part = rising(GetParam(), true), whole = rising(GetParam(), false);
    part.tfm.fixed_step = whole.tfm.fixed_step = 2e-3;
    if (forces) part = with_particle_forces(part), whole = with_particle_forces(whole);
    const End some = run(part), all = run(whole);
    core::Timers timers;
    const core::Grid grid = tfm::Model(whole, timers).constants().grid;
    EXPECT_GE(all.rows, 14 + 8 + 1);
    record("difference of fractions", distance(grid, some.fraction, all.fraction));
    EXPECT_LT(distance(grid, some.fraction, all.fraction), 1e-10);
    for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(some.volume[j] / all.volume[j], 1, 1e-13);
    EXPECT_EQ(some.evaluations, all.evaluations);
  }
}

// Steps of their own: within the tolerance, as entries that do not change count in the error's mean.
TEST_P(FollowBed, GivesItWithinTheToleranceAtStepsOfItsOwn) {
  core::Scene part = rising(GetParam(), true), whole = rising(GetParam(), false);
  part.tfm.rtol = whole.tfm.rtol = 1e-4;
  const End some = run(part), all = run(whole);
  core::Timers timers;
  const core::Grid grid = tfm::Model(whole, timers).constants().grid;
  record("difference of fractions", distance(grid, some.fraction, all.fraction));
  EXPECT_LT(distance(grid, some.fraction, all.fraction), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Integrators, FollowBed, testing::Values(std::string("explicit"), std::string("imex")));

}  // namespace
}  // namespace polybed::scenes
