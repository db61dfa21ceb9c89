// Discharges with a pressure: what flows through them follows from the pressures, and what leaves is counted.
#include <cmath>
#include <numbers>
#include "core/numerics/blocks.hpp"

#include "fluid/flow.hpp"
#include "scenes/ledgers.hpp"
#include "scenes/record.hpp"
#include "scenes/round_beds.hpp"

namespace polybed::scenes {
namespace {

using core::ColumnFace;

core::Discharge open_side(ColumnFace at, std::vector<double> from, std::vector<double> to, double pressure) {
  return {at, std::move(from), std::move(to), {}, pressure};
}

class Overflow : public testing::TestWithParam<const char*> {
 protected:
  static core::TfmIntegrator integrator() { return core::choice_of<core::TfmIntegrator>(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Integrators, Overflow, testing::Values("explicit", "imex", "implicit"));

/// Spheres as heavy as water in a box of 8 cells along the flow, under a lid.
core::Scene channel(double fraction) {
  core::Scene scene = uniform_bed(0.2e-3, 1000, 1000, 1e-3, fraction, 12, 0.06);
  scene.column.size[0] = 0.04;
  scene.column.cells[0] = 8;
  scene.column.sides = core::Boundary::wall;
  scene.column.outlet = core::Outlet::lid;
  scene.inlet.superficial_velocity = {{0.0, 0.0}};
  return scene;
}

/// Mean flux of the mixture to the right through the right side, m/s.
double to_the_right(const tfm::Model& model) {
  const core::Grid& grid = model.constants().grid;
  return model.overflow() / (grid.column_height() * grid.spacing[2]);
}

// From rest, between two sides with pressures: (n + 1) h dJ/dt = dp/rho - J^2, as half a cell beyond each side belongs
// to what is accelerated and what comes in was at rest. An even flow convects nothing else.
TEST_P(Overflow, APressureDifferenceAcceleratesTheMixture) {
  constexpr double pressure = 4.5, until = 0.1;
  core::Scene scene = channel(0.1);
  scene.discharges = {open_side(ColumnFace::left, {}, {}, pressure), open_side(ColumnFace::right, {}, {}, 0)};
  scene.tfm.integrator = integrator();
  scene.tfm.rtol = 1e-6;
  core::Timers timers;
  tfm::Model model(scene, timers);
  const std::vector<double> start = volumes(model);
  advance(model, until);
  const double greatest = std::sqrt(pressure / 1000), speed = greatest * std::tanh(greatest * until / (9 * 0.005));
  const double error = model.overflow() / speed;
  record("outflow less inflow, over the flow", error / (0.06 * model.constants().grid.spacing[2]));
  EXPECT_NEAR(error, 0, 1e-9);  // what comes in on the left leaves on the right
  const core::Grid& grid = model.constants().grid;
  for (int i = 0; i <= 8; ++i)
    EXPECT_NEAR(model.fields().fluid.flux[0][std::size_t(grid.index(i, 5))] / speed, 1, 1e-5) << i;
  EXPECT_EQ(model.passed()[0].in, 0);  // solids do not come back
  EXPECT_GT(model.passed()[0].out, 0);
  EXPECT_LT(ledger_error(model, start), 1e-12);
}

// A jet and a feed over the left side, an open right side: all goes on evenly, as with a discharge of the same flow.
TEST_P(Overflow, TakesWhatIsBrought) {
  constexpr double speed = 0.05, fraction = 0.1;
  core::Scene scene = channel(fraction);
  scene.jets.push_back({{0.0}, {0.06}, {{0.0, (1 - fraction) * speed}}, ColumnFace::left});
  scene.feeds.push_back({"solid", ColumnFace::left, {{0.0, fraction * speed}}, speed, {}, {}});
  scene.discharges = {open_side(ColumnFace::right, {}, {}, 0)};
  scene.tfm.integrator = integrator();
  core::Timers timers;
  tfm::Model model(scene, timers);
  const std::vector<double> start = volumes(model);
  advance_past_breakpoints(model, 2.0);
  record("flow out less that in, over it", to_the_right(model) / speed - 1);
  EXPECT_NEAR(to_the_right(model) / speed, 1, 1e-4);  // rtol; explicit steps end where the drag becomes unstable
  const double through = fraction * speed * 0.06 * model.constants().grid.spacing[2] * 2.0;
  EXPECT_NEAR(model.passed()[0].in / through, 1, 1e-10);
  EXPECT_NEAR(model.passed()[0].out / through, 1, 1e-3);
  EXPECT_LT(ledger_error(model, start), 1e-12);
}

/// Two species; an opening of a cell and a half in the bed, one of whole cells at its top and one at the bottom row.
core::Scene busy(core::TfmIntegrator integrator, core::Outlet outlet) {
  core::Scene scene = binary_bed(9, 40, 0.03, 0.16);
  scene.column.outlet = outlet;
  scene.tfm.integrator = integrator;
  scene.tfm.rtol = 1e-3;
  scene.tfm.pressure_tolerance = 1e-8;
  scene.bed.start_solids_fraction = 0.5;
  scene.inlet.superficial_velocity = {{0.0, 0.03}};
  scene.jets.push_back({{0.01}, {0.022}, {{0.0, 0.05}, {0.1, 0.05}, {0.1, 0.1}}, ColumnFace::left});
  scene.feeds.push_back({"fine", ColumnFace::left, {{0.0, 0.0}, {0.1, 0.004}}, 0.05, {0.04}, {0.048}});
  scene.discharges = {open_side(ColumnFace::right, {0.03}, {0.036}, 100),
                      open_side(ColumnFace::right, {0.06}, {0.08}, 0),
                      open_side(ColumnFace::left, {0.0}, {0.004}, 300)};
  return scene;
}

TEST_P(Overflow, TheLedgerClosesWhateverTheSteps) {
  for (const core::Outlet outlet : {core::Outlet::screen, core::Outlet::open, core::Outlet::lid}) {
    core::Timers timers;
    tfm::Model model(busy(integrator(), outlet), timers);
    const std::vector<double> start = volumes(model);
    advance_past_breakpoints(model, 0.25);
    record(fmt::format("ledger, {}", core::name_of(outlet)), ledger_error(model, start));
    EXPECT_LT(ledger_error(model, start), 1e-12);
    EXPECT_GT(model.passed()[0].out, 0);
    EXPECT_GT(model.passed()[1].out, 0);
    if (outlet != core::Outlet::lid) continue;  // all that comes in leaves through the sides
    const double in = (0.03 * 0.03 + 0.012 * 0.1 + 0.008 * 0.004) * 4.2e-3;
    record("flow out over that in, lid", model.overflow() / in);
    EXPECT_NEAR(model.overflow() / in, 1, 1e-6);
  }
}

TEST_P(Overflow, AResumedRunGivesTheSameBits) {
  core::Timers timers;
  const core::Scene scene = busy(integrator(), core::Outlet::lid);
  tfm::Model through(scene, timers), resumed(scene, timers);
  advance_past_breakpoints(through, 0.12);
  through.restart();
  resumed.resume(through.checkpoint());
  advance_past_breakpoints(through, 0.2);
  advance_past_breakpoints(resumed, 0.2);
  EXPECT_EQ(through.checkpoint().arrays.at("state"), resumed.checkpoint().arrays.at("state"));
  EXPECT_EQ(through.overflow(), resumed.overflow());
}

// The layers below 120 mm are as high as in the even column. Coarser ones above change the flow through each face by
// 0.6 %; twice that is allowed. (In the sum of all, outflow and inflow nearly cancel.)
TEST_P(Overflow, GradedLayersAboveChangeLittle) {
  std::vector<double> even;
  for (const bool graded : {false, true}) {
    core::Scene scene = busy(integrator(), core::Outlet::screen);
    scene.tfm.rtol = 1e-4;
    if (graded) {
      scene.column.layers.assign(30, 0.004);
      for (double height : {0.005, 0.006, 0.007, 0.01, 0.012}) scene.column.layers.push_back(height);
      scene.column.cells[1] = 35;
    }
    core::Timers timers;
    tfm::Model model(scene, timers);
    const std::vector<double> start = volumes(model);
    advance_past_breakpoints(model, 0.15);
    EXPECT_LT(ledger_error(model, start), 1e-12);
    double most = 0;
    for (std::size_t n = 0; n < model.boundaries().open_faces().size(); ++n) {
      const auto face = std::size_t(model.boundaries().open_faces()[n].face);
      const double flux = model.fields().fluid.flux[0][face];
      if (!graded) even.push_back(flux);
      most = std::max(most, std::abs(flux / even[n] - 1));
    }
    if (graded) record("flux through a face, graded over even, less 1", most);
    EXPECT_LT(most, 0.012);
  }
}

// Rings in the wall of a round column of 60 mm: a jet, a feed, a discharge and an overflow. Per cross-section a ring of
// height h carries 2 h/R of its velocity.
TEST_P(Overflow, RingsInTheWallOfARoundColumn) {
  for (const bool open : {false, true}) {
    core::Scene scene = busy(integrator(), open ? core::Outlet::lid : core::Outlet::screen);
    scene.column.shape = core::ColumnShape::axisymmetric;
    scene.column.size[2] = std::numbers::pi * 0.03;  // so that width times depth is the cross-section
    scene.jets = {{{0.01}, {0.022}, {{0.0, 0.05}}, ColumnFace::right}};
    scene.feeds = {{"fine", ColumnFace::right, {{0.0, 0.004}}, 0.05, {0.04}, {0.048}}};
    scene.discharges = {{ColumnFace::right, {0.055}, {0.065}, {{0.0, 0.02}}, {}}};
    if (open) scene.discharges.push_back(open_side(ColumnFace::right, {0.07}, {0.086}, 0));
    core::Timers timers;
    tfm::Model model(scene, timers);
    const std::vector<double> start = volumes(model);
    advance_past_breakpoints(model, 0.1);
    const core::Grid& grid = model.constants().grid;
    const auto upward = [&](int level) {
      double flow = 0;
      for (int i = 0; i < 9; ++i) {
        const auto at = std::size_t(grid.index(i, level));
        flow += grid.metric->open[1][at] * model.fields().fluid.flux[1][at] / 9;
      }
      return flow;
    };
    constexpr double per_radius = 2 / 0.03, area = std::numbers::pi * 0.03 * 0.03;
    const double above = 0.03 + per_radius * (0.012 * 0.05 + 0.008 * 0.004 - 0.01 * 0.02);
    record("flow above the rings less the given, m/s", upward(17) - above);
    EXPECT_NEAR(upward(17), above, 1e-6);
    EXPECT_NEAR(upward(40), open ? 0 : above, 1e-6);
    EXPECT_NEAR(model.overflow() / area, open ? above : 0, 1e-6);
    EXPECT_NEAR(model.passed()[0].in / (per_radius * area * 0.008 * 0.004 * 0.1), 1, 1e-10);
    EXPECT_GT(model.passed()[1].out, 0);
    EXPECT_LT(ledger_error(model, start), 1e-12);
  }
}

// Rings in the wide part of a column that opens from 40 to 60 mm, below an overflow under a lid. The cone ends within
// the row of the lowest ring.
TEST_P(Overflow, RingsAboveACone) {
  core::Scene scene = busy(integrator(), core::Outlet::lid);
  scene.column.shape = core::ColumnShape::axisymmetric;
  scene.column.size[2] = std::numbers::pi * 0.03;
  scene.column.profile = {{0, 0.04}, {0.05, 0.06}, {0.16, 0.06}};
  scene.bed.static_height = 0.03;
  scene.jets = {{{0.05}, {0.06}, {{0.0, 0.05}}, ColumnFace::right}};
  scene.feeds = {{"fine", ColumnFace::right, {{0.0, 0.004}}, 0.05, {0.08}, {0.09}}};
  scene.discharges = {{ColumnFace::right, {0.064}, {0.07}, {{0.0, 0.02}}, {}},
                      open_side(ColumnFace::right, {0.1}, {0.12}, 0)};
  core::Timers timers;
  tfm::Model model(scene, timers);
  const std::vector<double> start = volumes(model);
  advance_past_breakpoints(model, 0.05);
  constexpr double per_height = 2 * std::numbers::pi * 0.03, below = std::numbers::pi * 0.02 * 0.02 * 0.03,
                   out = per_height * (0.01 * 0.05 + 0.01 * 0.004 - 0.006 * 0.02) + below;
  EXPECT_NEAR(model.overflow() / out, 1, 1e-5);
  EXPECT_NEAR(model.passed()[0].in / (per_height * 0.01 * 0.004 * 0.05), 1, 1e-10);
  EXPECT_LT(ledger_error(model, start), 1e-12);
}

// Beads lighter than the water through a third of the top, against a lid or into a downward flow that is given at both
// ends. By hand 0.01 x (0.05 + 0.05/2) x 0.002 = 1.5e-6 m2 enter by 0.1 s, times the depth.
TEST_P(Overflow, SolidsAreFedThroughAClosedTop) {
  for (const bool lid : {true, false}) {
    core::Scene scene = busy(integrator(), lid ? core::Outlet::lid : core::Outlet::screen);
    scene.species[0].density = scene.species[1].density = 800;
    scene.effects = {{"drag", "wen_yu"}, {"solids_stress", "frictional"}};
    scene.jets.clear();
    scene.feeds = {{"fine", ColumnFace::top, {{0.0, 0.0}, {0.05, 0.002}}, 0.05, {0.01}, {0.02}}};
    if (!lid) {
      scene.inlet = {{{0.0, -0.02}}, {}, core::ColumnEnd::top};
      scene.discharges.clear();
    }
    core::Timers timers;
    tfm::Model model(scene, timers);
    const std::vector<double> start = volumes(model);
    advance_past_breakpoints(model, 0.1);
    EXPECT_LT(ledger_error(model, start), 1e-12);
    EXPECT_NEAR(model.passed()[0].in / (1.5e-6 * 4.2e-3), 1, 1e-2);
    const core::Grid& grid = model.constants().grid;
    double above = 0, middle = 0;
    for (int i = 0; i < 9; ++i) {
      above += model.fields().fluid.flux[1][std::size_t(grid.index(i, 40))] / 9;
      middle += model.fields().fluid.flux[1][std::size_t(grid.index(i, 30))] / 9;
    }
    EXPECT_NEAR(above, lid ? -0.002 / 3 : -0.02, 1e-12);
    EXPECT_NEAR(middle, above, 1e-6);
    const double in = 4.2e-3 * (0.03 * 0.03 + 0.01 * 0.002);
    EXPECT_NEAR(model.overflow() / in, lid ? 1 : 0, 1e-6);
  }
}

// The fluid of the particle model alone, stepped by 1 ms: the same acceleration to round-off of the pressure's solver.
TEST(OverflowOfParticles, APressureDifferenceAcceleratesTheFluid) {
  core::Scene scene = channel(0);
  scene.discharges = {open_side(ColumnFace::left, {}, {}, 4.5), open_side(ColumnFace::right, {}, {}, 0)};
  const core::Grid grid = core::grid_of(scene, nullptr);
  fluid::Flow flow(scene, grid, 1e-10);
  const fluid::ParticlePhase none(grid, false);
  flow.begin(0, none);
  for (int n = 0; n < 100; ++n) flow.advance(1e-3 * n, 1e-3, none);
  double speed = 0;
  for (int n = 0; n < 100; ++n) speed += 1e-3 * (4.5 / 1000 - speed * speed) / (9 * 0.005);
  for (int i = 0; i <= 8; ++i)
    EXPECT_NEAR(flow.state().velocity[0][std::size_t(grid.index(i, 5))] / speed, 1, 1e-7) << i;
}

// Under a lid the pressure outside is that inside from the start: nothing pushes the particles next to the port.
TEST(OverflowOfParticles, StartsAtThePressureOutside) {
  constexpr double outside = 1e5;
  core::Scene scene = channel(0);
  scene.discharges = {open_side(ColumnFace::right, {0.031}, {0.046}, outside)};
  const core::Grid grid = core::grid_of(scene, nullptr);
  fluid::Flow flow(scene, grid, 1e-10);
  const fluid::ParticlePhase none(grid, false);
  flow.begin(0, none);
  for (int j = 0; j < 12; ++j) {
    const auto at = std::size_t(grid.index(8, j));
    EXPECT_NEAR(flow.state().pressure[std::size_t(grid.index(3, j))] / outside, 1, 1e-8) << j;
    EXPECT_NEAR(flow.gradient()[0][at] * grid.spacing[0] / outside, 0, 1e-8) << j;
  }
  flow.advance(0, 1e-3, none);
  EXPECT_NEAR(flow.overflow() / (0.06 * grid.spacing[2]), 0, 1e-7);
}

// Particles that do not move leave their voidage of the hole to the fluid, which flows alone: u = J/eps is what the
// fluid had without them.
TEST(OverflowOfParticles, HeldParticlesDoNotLeave) {
  core::Scene scene = channel(0);
  scene.bed.held = true;
  scene.discharges = {open_side(ColumnFace::left, {}, {}, 4.5), open_side(ColumnFace::right, {}, {}, 0)};
  const core::Grid grid = core::grid_of(scene, nullptr);
  fluid::Flow flow(scene, grid, 1e-10);
  fluid::ParticlePhase half(grid, false);
  std::fill(half.voidage.begin(), half.voidage.end(), 0.5);
  for (core::Field& on_face : half.voidage_on) std::fill(on_face.begin(), on_face.end(), 0.5);
  flow.begin(0, half);
  for (int n = 0; n < 100; ++n) flow.advance(1e-3 * n, 1e-3, half);
  double speed = 0;
  for (int n = 0; n < 100; ++n) speed += 1e-3 * (4.5 / 1000 - speed * speed) / (9 * 0.005);
  for (int i = 1; i < 8; ++i)
    EXPECT_NEAR(flow.state().velocity[0][std::size_t(grid.index(i, 5))] / speed, 1, 1e-7) << i;
  EXPECT_NEAR(flow.overflow() / (0.06 * grid.spacing[2]), 0, 1e-9);
}

// A quarter of the right side under a lid: what enters through the bottom leaves there, at once and later.
TEST(OverflowOfParticles, UnderALidAllLeavesThroughTheSide) {
  core::Scene scene = channel(0);
  scene.inlet.superficial_velocity = {{0.0, 0.01}, {0.05, 0.01}, {0.1, 0.02}};
  scene.discharges = {open_side(ColumnFace::right, {0.031}, {0.046}, 0)};
  const core::Grid grid = core::grid_of(scene, nullptr);
  fluid::Flow flow(scene, grid, 1e-10);
  const fluid::ParticlePhase none(grid, false);
  flow.begin(0, none);
  const double bottom = 0.04 * grid.spacing[2];
  for (int n = 0; n < 200; ++n) {
    flow.advance(1e-3 * n, 1e-3, none);
    const double given = flow.inlet().mean_velocity(1e-3 * (n + 1)) * bottom;
    ASSERT_NEAR(flow.overflow() / given, 1, 1e-8) << n;
  }
}

}  // namespace
}  // namespace polybed::scenes
