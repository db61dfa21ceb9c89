// A box whose bottom and top are joined, as a continuum: the slip of a uniform suspension, conservation, shifts, and
// the flow that a given gradient drives.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "scenes/record.hpp"
#include "tfm/mean_flow.hpp"

namespace polybed::scenes {
namespace {

using Kind = tfm::StateLayout::Entry::Kind;

constexpr double liquid = 1000, viscosity = 0.01, gravity = 9.81;

/// 0.5 mm, 1200 kg/m3 and 0.4 mm, 2000 kg/m3, fractions 0.2 and 0.1, in a liquid of 1000 kg/m3, 0.01 Pa s.
core::Scene suspension(const std::string& integrator, int cells = 8) {
  core::Scene scene = uniform_bed(0.5e-3, 1200, liquid, viscosity, 0.3, cells, 0.04);
  scene.species.push_back(scene.species[0]);
  scene.species[1].name = "second";
  scene.species[1].diameter = 0.4e-3;
  scene.species[1].density = 2000;
  scene.bed.volume_share = {2.0 / 3, 1.0 / 3};
  scene.column.ends = core::Boundary::periodic;
  scene.inlet.superficial_velocity.clear();
  scene.effects = {{"drag", "stokes"}};
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
  scene.tfm.rtol = 1e-6;
  scene.tfm.pressure_tolerance = 1e-12;
  return scene;
}

measures::BoxFlow flow_of(const tfm::Model& model) {
  return tfm::box_flow(model.constants(), model.mean_gradient(), model.fields());
}

class JoinedEnds : public testing::TestWithParam<std::string> {};

// G = -(0.2 200 + 0.1 1000) 9.81 = -1373.4 Pa/m; with f = 1 the drag 18 mu eps/D^2 slip carries (rho_j - rho_f) g + G:
// slips of (200 - 140) 9.81 0.25e-6/(18 0.01 0.7) = 1.167857e-3 and (1000 - 140) 9.81 0.16e-6/0.126 = 10.713143e-3 m/s,
// reached after some relaxation times of 4 ms. 1e-6 of rtol in each of some ten steps.
TEST_P(JoinedEnds, AUniformSuspensionStaysUniformAndHasTheSlipOfItsLaw) {
  core::Timers timers;
  tfm::Model model(suspension(GetParam()), timers);
  advance(model, 0.5);
  const measures::BoxFlow box = flow_of(model);
  EXPECT_NEAR(box.gradient, -1373.4, 1e-9);
  EXPECT_NEAR(box.fluid - box.velocity[0], 1.1678571e-3, 2e-8);
  EXPECT_NEAR(box.fluid - box.velocity[1], 10.7131429e-3, 2e-7);
  record("velocity of the centre of mass over the slip", box.mass_velocity / 10.7e-3);
  EXPECT_NEAR(box.mass_velocity, 0, 1e-13 * 10.7e-3);  // round-off of some hundred evaluations
  const core::Grid& grid = model.constants().grid;
  for (std::size_t j = 0; j < 2; ++j)
    for (int y = 0; y < grid.cells[1]; ++y) {
      const auto at = std::size_t(grid.index(0, y)), first = std::size_t(grid.index(0, 0));
      EXPECT_NEAR(model.fields().solids.fraction[j][at], j == 0 ? 0.2 : 0.1, 1e-14);
      EXPECT_NEAR(model.fields().solids.velocity[j][1][at], model.fields().solids.velocity[j][1][first], 1e-14);
    }
}

/// Waves of the fractions along both axes.
core::Scene waves_of(const std::string& integrator) {
  core::Scene scene = suspension(integrator, 12);
  scene.column.size = {0.02, 0.04, 1e-3};
  scene.column.cells = {6, 12, 1};
  scene.effects["fluid_stress"] = "newtonian";
  return scene;
}

/// \param shift  in cells, upwards
void start_waves(tfm::Model& model, int shift) {
  make_uneven(model, [&](int i, int j, int) {
    return 1 + 0.2 * std::sin(2 * std::numbers::pi * (j - shift + 0.5) / 12) *
                   std::cos(2 * std::numbers::pi * (i + 0.3) / 6);
  });
}

// In time phi U is a product of unknowns, so momentum is kept to the tolerance, 1e-6 of the velocities.
TEST_P(JoinedEnds, WavesKeepTheMassesToRoundOffAndTheMomentumToTheTolerance) {
  core::Timers timers;
  tfm::Model model(waves_of(GetParam()), timers);
  start_waves(model, 0);
  model.show(0);
  const std::vector<double> before = measures::species_volumes(model.constants().grid, model.fields().solids);
  advance(model, 0.2);
  const std::vector<double> after = measures::species_volumes(model.constants().grid, model.fields().solids);
  for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(after[j] / before[j], 1, 1e-13);
  const measures::BoxFlow box = flow_of(model);
  record("velocity of the centre of mass over the slip", box.mass_velocity / 10.7e-3);
  EXPECT_NEAR(box.mass_velocity, 0, 1e-6 * 10.7e-3);
  double most = 0;
  for (const double u : model.fields().solids.velocity[0][1]) most = std::max(most, std::abs(u));
  EXPECT_GT(most, 1.2e-3);  // they have moved
}

// The waves reach 0.36, above the onset of the frictional pressure: no bottom bears it, so it moves nothing as a whole.
TEST_P(JoinedEnds, AFrictionalStressKeepsTheMomentum) {
  core::Timers timers;
  core::Scene scene = waves_of(GetParam());
  scene.effects["solids_stress"] = "frictional";
  scene.tfm.frictional_onset = 0.3;
  scene.tfm.max_packing = 0.64;
  tfm::Model model(scene, timers);
  start_waves(model, 0);
  model.show(0);
  EXPECT_GT(model.fields().stress.pressure[std::size_t(model.constants().grid.index(0, 2))], 0);
  advance(model, 0.2);
  const measures::BoxFlow box = flow_of(model);
  record("velocity of the centre of mass over the slip, frictional", box.mass_velocity / 10.7e-3);
  EXPECT_NEAR(box.mass_velocity, 0, 1e-6 * 10.7e-3);
}

// A state that begins half a box higher ends half a box higher: nothing knows where the ends are. The differences are
// round-off in the solver, which error control and the waves hardly amplify.
TEST_P(JoinedEnds, AShiftedStateStaysShifted) {
  core::Timers timers;
  const auto after = [&](int shift) {
    tfm::Model model(waves_of(GetParam()), timers);
    start_waves(model, shift);
    advance(model, 0.05);
    std::vector<double> values;
    const core::Grid& grid = model.constants().grid;
    for (int j = 0; j < 12; ++j)
      for (int i = 0; i < 6; ++i) {
        const auto at = std::size_t(grid.index(i, (j + shift) % 12));
        values.push_back(model.fields().solids.fraction[0][at]);
        values.push_back(model.fields().solids.velocity[1][1][at]);
        values.push_back(model.fields().fluid.velocity[0][at]);
      }
    return values;
  };
  const std::vector<double> one = after(0), other = after(6);
  double most = 0;
  for (std::size_t n = 0; n < one.size(); ++n) most = std::max(most, std::abs(one[n] - other[n]));
  record("greatest difference", most);
  EXPECT_LT(most, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Integrators, JoinedEnds,
                         testing::Values(std::string("explicit"), std::string("imex"), std::string("implicit")));

/// Relative error of the mean velocity between walls 10 mm apart: G H^2/(12 mu), 0.02 m/s.
double channel_error(int nx) {
  constexpr double width = 0.01, thick = 0.1, gradient = -240;
  core::Scene scene = uniform_bed(1e-3, 2000, 1000, thick, 0.5, 4, width);
  scene.column.size = {width, width, width};
  scene.column.cells = {nx, 4, 1};
  scene.column.sides = core::Boundary::wall;
  scene.column.ends = core::Boundary::periodic;
  scene.column.pressure_gradient = gradient;
  scene.bed.static_height = 0;
  scene.effects = {{"drag", "stokes"}, {"fluid_stress", "newtonian"}};
  scene.tfm.rtol = 1e-6;
  core::Timers timers;
  tfm::Model model(scene, timers);
  advance(model, 2.0);  // the slowest disturbance falls to 1/e in H^2/(pi^2 nu) = 0.1 s
  const measures::BoxFlow box = flow_of(model);
  EXPECT_EQ(box.gradient, gradient);
  return std::abs(box.fluid / (-gradient * width * width / (12 * thick)) - 1);
}

// The parabola at the centres of n cells, with mirrored values beyond the walls, has a mean 2/n^2 too large. The rest
// is the tolerance of the steps.
TEST(JoinedBox, AGivenGradientDrivesPoiseuillesFlow) {
  const double coarse = channel_error(8), fine = channel_error(16);
  record("mean velocity, 8", coarse);
  record("mean velocity, 16", fine);
  EXPECT_NEAR(coarse, 2.0 / (8 * 8), 1e-5);
  EXPECT_NEAR(fine, 2.0 / (16 * 16), 1e-5);
}

TEST(JoinedBox, ARestartHasTheSameBits) {
  for (const char* integrator : {"explicit", "implicit"}) {
    const TwoEnds ends = through_and_resumed(waves_of(integrator), 0.01, 0.02);
    EXPECT_EQ(ends.through.arrays.at("state"), ends.resumed.arrays.at("state"));
  }
}

}  // namespace
}  // namespace polybed::scenes
