// Mass to round-off, volume of the mixture to the solver's tolerance, bounds, and a restart to the bit.
#include <gtest/gtest.h>

#include <algorithm>

#include "fluid/pressure.hpp"
#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

class Conservation : public testing::TestWithParam<const char*> {};

TEST_P(Conservation, MassBoundsAndVolume) {
  core::Scene scene = binary_bed(10, 60, 0.03, 0.18);
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(GetParam());
  scene.tfm.rtol = 1e-3;
  core::Timers timers;
  tfm::Model model(scene, timers);
  model.show(0);
  const std::vector<double> before = measures::species_volumes(model.constants().grid, model.fields().solids);
  advance(model, 1.0);
  const std::vector<double> after = measures::species_volumes(model.constants().grid, model.fields().solids);
  for (std::size_t j = 0; j < 2; ++j) {
    record(fmt::format("relative change of mass {}", j), after[j] / before[j] - 1);
    EXPECT_NEAR(after[j], before[j], 1e-12 * before[j]);
  }
  const tfm::Fields& fields = model.fields();
  const core::Grid& grid = model.constants().grid;
  double least = 1, most = 0;
  core::for_each_row(grid, [&](core::Index begin, core::Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      for (const core::Field& phi : fields.solids.fraction) least = std::min(least, phi[c]);
      most = std::max(most, fields.solids_fraction[c]);
    }
  });
  // Undershoot of a fraction: ten absolute tolerances. Overshoot: the compliance of the frictional stress.
  EXPECT_GE(least, -10 * 0.1 * scene.tfm.rtol);
  EXPECT_LE(most, model.effects().solids_stress->max_packing() + 1e-3);
  EXPECT_LT(fluid::divergence_error(grid, fields.fluid.flux, model.velocity_scale()), 1e-2);
}

TEST_P(Conservation, ResumedRunGivesTheSameBits) {
  core::Scene scene = binary_bed(6, 40, 0.018, 0.12);
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(GetParam());
  scene.tfm.rtol = 1e-3;
  const TwoEnds ends = through_and_resumed(scene, 0.2, 0.4);
  EXPECT_EQ(ends.through.arrays.at("state"), ends.resumed.arrays.at("state"));
  EXPECT_EQ(ends.work_through.steps, ends.work_resumed.steps);
}

TEST_P(Conservation, ResumedRunWithForcesOnParticlesGivesTheSameBits) {
  core::Scene scene = with_particle_forces(binary_bed(6, 40, 0.018, 0.12));
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(GetParam());
  scene.tfm.rtol = 1e-3;
  const TwoEnds ends = through_and_resumed(scene, 0.2, 0.4);
  EXPECT_EQ(ends.through.arrays.at("state"), ends.resumed.arrays.at("state"));
  EXPECT_EQ(ends.work_through.steps, ends.work_resumed.steps);
}

INSTANTIATE_TEST_SUITE_P(Integrators, Conservation, testing::Values("explicit", "imex", "implicit"));

TEST(Integrators, AgreeAtTightTolerance) {
  core::Scene scene = binary_bed(6, 40, 0.018, 0.12);
  scene.bed.start_solids_fraction = 0.45;
  scene.tfm.rtol = 1e-6;
  core::Timers timers;
  tfm::Model by_steps(scene, timers);
  scene.tfm.integrator = core::TfmIntegrator::implicit_steps;
  tfm::Model by_newton(scene, timers);
  advance(by_steps, 0.1);
  advance(by_newton, 0.1);
  // Each keeps its error near 1e-6 per step; what they share is the operator. 1e-4 is a hundred times that.
  const double apart =
      distance(by_steps.constants().grid, by_steps.fields().solids.fraction[0], by_newton.fields().solids.fraction[0]);
  record("distance", apart);
  EXPECT_LT(apart, 1e-4);
}

}  // namespace
}  // namespace polybed::scenes
