// Ports in the wall of a tube: in a plain one, with graded layers, above a cone and around a rod.
#include <cmath>
#include <numbers>

#include "core/case/grading.hpp"
#include "scenes/ledgers.hpp"
#include "scenes/record.hpp"
#include "scenes/round_beds.hpp"

namespace polybed::scenes {
namespace {

using core::ColumnFace;

class TubePorts : public testing::TestWithParam<const char*> {
 protected:
  static core::TfmIntegrator integrator() { return core::choice_of<core::TfmIntegrator>(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Integrators, TubePorts, testing::Values("explicit", "imex", "implicit"));

/// A tube of 30 mm with a jet, a feed and a discharge in its wall, and one or two overflows: 8 by 8 by 30 cells.
core::Scene tube_with_ports(core::TfmIntegrator integrator, bool open) {
  core::Scene scene = binary_bed(9, 40, 0.03, 0.16);
  scene.column.outlet = open ? core::Outlet::lid : core::Outlet::screen;
  scene.tfm.integrator = integrator;
  scene.tfm.rtol = 1e-3;
  scene.tfm.pressure_tolerance = 1e-8;
  scene.bed.start_solids_fraction = 0.5;
  scene.inlet.superficial_velocity = {{0.0, 0.03}};
  scene.column.shape = core::ColumnShape::cylinder;
  scene.column.dimensions = 3;
  scene.column.size = {0.03, 0.12, 0.03};
  scene.column.cells = {8, 30, 8};
  scene.jets = {{{0.009, 0.01}, {0.0165, 0.022}, {{0.0, 0.05}}, ColumnFace::front}};
  scene.feeds = {{"fine", ColumnFace::left, {{0.0, 0.004}}, 0.05, {0.008, 0.07}, {0.02, 0.082}}};
  scene.discharges = {{ColumnFace::back, {0.01, 0.03}, {0.02, 0.04}, {{0.0, 0.02}}, {}}};
  if (open) scene.discharges.push_back({ColumnFace::right, {0.011, 0.06}, {0.019, 0.074}, {}, 0.0});
  return scene;
}

// Each port has the area of its rectangle, in whatever cells of the cut wall: to the pressure's tolerance, 1e-8, times
// some. What has left by all ways is what is missing.
TEST_P(TubePorts, HaveTheirAreas) {
  constexpr double area = std::numbers::pi * 0.015 * 0.015, jet = 0.0075 * 0.012 * 0.05, feed = 0.012 * 0.012 * 0.004,
                   discharge = 0.01 * 0.01 * 0.02;
  for (const bool open : {false, true}) {
    const core::Scene scene = tube_with_ports(integrator(), open);
    core::Timers timers;
    tfm::Model model(scene, timers);
    const std::vector<double> start = volumes(model);
    advance_past_breakpoints(model, 0.1);
    const core::Grid& grid = model.constants().grid;
    const core::Field& upward = model.fields().fluid.flux[1];
    EXPECT_NEAR(passing(grid, upward, 7) / (0.03 * area + jet), 1, 1e-6);
    EXPECT_NEAR(passing(grid, upward, 12) / (0.03 * area + jet - discharge), 1, 1e-6);
    const double out = 0.03 * area + jet + feed - discharge;
    record("flow out over the given, less 1", (open ? model.overflow() : passing(grid, upward, 30)) / out - 1);
    EXPECT_NEAR((open ? model.overflow() : passing(grid, upward, 30)) / out, 1, 1e-6);
    EXPECT_NEAR(model.passed()[0].in / (feed * 0.1), 1, 1e-10);
    EXPECT_GT(model.passed()[1].out, 0);
    EXPECT_LT(ledger_error(model, start), 1e-12);
    const std::vector<double> flows = model.exits().flows(0.1, model.fields().fluid.flux);
    ASSERT_EQ(flows.size(), 2u);
    EXPECT_NEAR(flows[0] / discharge, 1, 1e-12);
    EXPECT_NEAR(flows[1] / out, 1, 1e-6);
    for (std::size_t j = 0; j < 2; ++j) {
      const auto left = model.exits().passed(model.constants().openings, model.fields().solids);
      EXPECT_NEAR(left[0][j] + left[1][j], model.passed()[j].out, 1e-12 * start[j]);
    }
  }
}

/// The tube with layers that grow from below the overflow on, above a cone, and around a rod of 12 mm.
std::vector<core::Scene> other_tubes(core::TfmIntegrator integrator) {
  std::vector<core::Scene> scenes(3, tube_with_ports(integrator, true));
  scenes[0].column.layers = core::graded_layers(0.12, 30, 0.05, 1.2);
  scenes[0].column.cells[1] = int(scenes[0].column.layers.size());
  scenes[1].column.profile = {{0, 0.02}, {0.009, 0.03}, {0.12, 0.03}};
  core::InnerWall rod;
  rod.shape = core::WallShape::cylinder;
  rod.from = {0.004, 0.025};
  rod.to = {0.004, 0.09};
  rod.thickness = 0.008;
  scenes[2].walls = {rod};
  return scenes;
}

// Through each level flows what the ports leave, as in the tube alone.
TEST_P(TubePorts, FlowInOtherTubesAsGiven) {
  constexpr double jet = 0.0075 * 0.012 * 0.05, feed = 0.012 * 0.012 * 0.004, discharge = 0.01 * 0.01 * 0.02;
  for (const core::Scene& scene : other_tubes(integrator())) {
    core::Timers timers;
    tfm::Model model(scene, timers);
    const std::vector<double> start = volumes(model);
    advance_past_breakpoints(model, 0.05);
    const double radius = scene.column.is_tapered() ? 0.01 : 0.015, inlet = 0.03 * std::numbers::pi * radius * radius;
    const core::Grid& grid = model.constants().grid;
    EXPECT_NEAR(passing(grid, model.fields().fluid.flux[1], 12) / (inlet + jet - discharge), 1, 1e-6);
    EXPECT_NEAR(model.overflow() / (inlet + jet + feed - discharge), 1, 1e-6);
    EXPECT_NEAR(model.passed()[0].in / (feed * 0.05), 1, 1e-10);
    EXPECT_GT(model.passed()[1].out, 0);
    EXPECT_LT(ledger_error(model, start), 1e-12);
  }
}

TEST_P(TubePorts, AResumedRunGivesTheSameBits) {
  std::vector<core::Scene> scenes = other_tubes(integrator());
  scenes.push_back(tube_with_ports(integrator(), true));
  for (const core::Scene& scene : scenes) {
    core::Timers timers;
    tfm::Model through(scene, timers), resumed(scene, timers);
    advance_past_breakpoints(through, 0.02);
    through.restart();
    resumed.resume(through.checkpoint());
    advance_past_breakpoints(through, 0.04);
    advance_past_breakpoints(resumed, 0.04);
    EXPECT_EQ(through.checkpoint().arrays.at("state"), resumed.checkpoint().arrays.at("state"));
  }
}

}  // namespace
}  // namespace polybed::scenes
