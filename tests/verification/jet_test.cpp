// A jet: what flows in, flows through every level, from the first moment and when the jet is switched.
#include <gtest/gtest.h>

#include "fluid/pressure.hpp"
#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

/// Mean vertical flux through level j.
double through(const tfm::Model& model, int j) {
  const core::Grid& grid = model.constants().grid;
  double sum = 0;
  for (int i = 0; i < grid.cells[0]; ++i)
    sum += model.fields().fluid.flux[1][std::size_t(grid.index(i, j))] / grid.cells[0];
  return sum;
}

class Jet : public testing::TestWithParam<const char*> {};

// 10 of 30 mm at 0.12 m/s, the rest at 0.015: 0.05 m/s in the mean; doubled at 0.05 s. The flux through a level is as
// exact as the pressure solve (its tolerance is 1e-8 here), and solids rise above the jet.
TEST_P(Jet, EveryLevelCarriesWhatFlowsIn) {
  core::Scene scene = binary_bed(9, 40, 0.03, 0.16);
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(GetParam());
  scene.tfm.pressure_tolerance = 1e-8;
  scene.tfm.rtol = 1e-3;
  scene.bed.start_solids_fraction = 0.5;
  scene.inlet.superficial_velocity = {{0.0, 0.015}};
  scene.jets.push_back({{0.01}, {0.02}, {{0.0, 0.12}, {0.05, 0.12}, {0.05, 0.24}}});
  core::Timers timers;
  tfm::Model model(scene, timers);
  model.show(0);
  for (const int j : {0, 1, 20, 40}) EXPECT_NEAR(through(model, j), 0.05, 1e-7) << j;
  advance(model, 0.05);
  model.restart();  // as the run does at a breakpoint of the inlet
  model.show(0.05);
  for (const int j : {0, 1, 20, 40}) EXPECT_NEAR(through(model, j), 0.09, 1e-6) << j;
  EXPECT_LT(fluid::divergence_error(model.constants().grid, model.fields().fluid.flux, model.velocity_scale()), 1e-2);
  advance(model, 0.2);
  const core::Grid& grid = model.constants().grid;
  const auto& u = model.fields().solids.velocity[0][1];
  EXPECT_GT(u[std::size_t(grid.index(4, 4))], u[std::size_t(grid.index(0, 4))] + 0.01);
}

// After a ramp, too, every level carries exactly what the inlet says, whatever the tolerance in time.
TEST_P(Jet, ARampEndsWhereItShould) {
  core::Scene scene = binary_bed(4, 40, 0.012, 0.16);
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(GetParam());
  scene.tfm.pressure_tolerance = 1e-8;
  scene.tfm.rtol = 1e-3;
  scene.inlet.superficial_velocity = {{0.0, 0.01}, {0.1, 0.04}};
  core::Timers timers;
  tfm::Model model(scene, timers);
  advance(model, 0.1);
  model.restart();
  advance(model, 0.2);
  for (const int j : {0, 1, 20, 40}) EXPECT_NEAR(through(model, j), 0.04, j == 0 ? 1e-15 : 1e-6) << j;
}

INSTANTIATE_TEST_SUITE_P(Integrators, Jet, testing::Values("explicit", "imex", "implicit"));

}  // namespace
}  // namespace polybed::scenes
