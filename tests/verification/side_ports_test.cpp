// Fluid and solids through the sides of a column: every level carries what has come in below it, what enters and leaves
// is counted to round-off, and left and right, front and back, differ in nothing but their names.
#include "scenes/ledgers.hpp"
#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

using core::ColumnFace;

class SidePorts : public testing::TestWithParam<const char*> {
 protected:
  static core::TfmIntegrator integrator() { return core::choice_of<core::TfmIntegrator>(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Integrators, SidePorts, testing::Values("explicit", "imex", "implicit"));

/// Greatest difference of a field on faces from a value, on the owned faces of its axis.
double farthest(const core::Grid& grid, const core::Field& field, int axis, double value) {
  double most = 0;
  core::for_each_row(grid, core::owned_faces(grid, axis), [&](core::Index begin, core::Index end) {
    for (core::Index c = begin; c < end; ++c) most = std::max(most, std::abs(field[std::size_t(c)] - value));
  });
  return most;
}

// Spheres as heavy as the water, a tenth of it, brought by a jet and a feed over the whole left side and drawn off over
// the whole right one at 50 mm/s: all goes on evenly. Nothing crosses the top, through which only the rest would flow.
TEST_P(SidePorts, ACrossFlowIsUniform) {
  constexpr double speed = 0.05, fraction = 0.1;
  core::Scene scene = uniform_bed(0.2e-3, 1000, 1000, 1e-3, fraction, 12, 0.06);
  scene.column.size[0] = 0.04;
  scene.column.cells[0] = 8;
  scene.column.sides = core::Boundary::wall;
  scene.inlet = {{{0.0, 0.0}}, {}, core::ColumnEnd::top};
  scene.jets.push_back({{0.0}, {0.06}, {{0.0, (1 - fraction) * speed}}, ColumnFace::left});
  scene.feeds.push_back({"solid", ColumnFace::left, {{0.0, fraction * speed}}, speed, {}, {}});
  scene.discharges.push_back({ColumnFace::right, {}, {}, {{0.0, speed}}});
  scene.tfm.integrator = integrator();
  core::Timers timers;
  tfm::Model model(scene, timers);
  const std::vector<double> start = volumes(model);
  advance_past_breakpoints(model, 2.0);  // two and a half passages
  const core::Grid& grid = model.constants().grid;
  const double across = farthest(grid, model.fields().fluid.flux[0], 0, speed),
               upward = farthest(grid, model.fields().fluid.flux[1], 1, 0),
               solids = farthest(grid, model.fields().solids.velocity[0][0], 0, speed);
  double uneven = 0;
  core::for_each_row(grid, [&](core::Index begin, core::Index end) {
    for (core::Index c = begin; c < end; ++c)
      uneven = std::max(uneven, std::abs(model.fields().solids.fraction[0][std::size_t(c)] - fraction));
  });
  record("flux across less the given, m/s", across);
  record("flux upwards, m/s", upward);
  record("solids' velocity less the given, m/s", solids);
  record("fraction less the given", uneven);
  // Explicit steps end where the drag becomes unstable, whose growth the error test stops at rtol of the velocity; the
  // others keep what the pressure's solver and Newton leave.
  const double most = integrator() == core::TfmIntegrator::explicit_steps ? scene.tfm.rtol * speed : 1e-10;
  EXPECT_LT(across, most);
  EXPECT_LT(upward, most);
  EXPECT_LT(solids, most);
  EXPECT_LT(uneven, most);
  const double through = fraction * speed * 0.06 * grid.spacing[2] * 2.0;
  EXPECT_NEAR(model.passed()[0].in / through, 1, 1e-10);
  EXPECT_NEAR(model.passed()[0].out / through, 1, most / fraction);
  EXPECT_LT(ledger_error(model, start), 1e-12);
}

/// Two species under an open outlet; a jet and a feed in the left side, a jet in the right one and a discharge there
/// from the bed and one from above it.
core::Scene busy_sides(core::TfmIntegrator integrator) {
  core::Scene scene = binary_bed(9, 40, 0.03, 0.16);
  scene.column.outlet = core::Outlet::open;
  scene.tfm.integrator = integrator;
  scene.tfm.rtol = 1e-3;
  scene.tfm.pressure_tolerance = 1e-8;
  scene.bed.start_solids_fraction = 0.5;
  scene.inlet.superficial_velocity = {{0.0, 0.02}};
  scene.jets.push_back({{0.01}, {0.022}, {{0.0, 0.05}, {0.1, 0.05}, {0.1, 0.1}}, ColumnFace::left});
  scene.jets.push_back({{0.1}, {0.105}, {{0.0, 0.0}, {0.2, 0.04}}, ColumnFace::right});
  scene.feeds.push_back(
      {"fine", ColumnFace::left, {{0.0, 0.0}, {0.1, 0.004}, {0.15, 0.004}, {0.15, 0.001}}, 0.05, {0.04}, {0.048}});
  scene.discharges.push_back({ColumnFace::right, {0.02}, {0.034}, {{0.0, 0.01}}});
  scene.discharges.push_back({ColumnFace::right, {0.12}, {0.13}, {{0.0, 0.0}, {0.1, 0.0}, {0.1, 0.02}}});
  return scene;
}

// By hand: fine 0.008 x (0.5 x 0.1 x 0.004 + 0.05 x 0.004 + 0.15 x 0.001) = 4.4e-6 m2, times the depth, as in
// openings_test.cpp; and the discharge in the bed takes at most a bed's fraction of 0.014 x 0.01 x 0.3 = 4.2e-5 m2.
TEST_P(SidePorts, TheLedgerClosesWhateverTheSteps) {
  core::Timers timers;
  const core::Scene scene = busy_sides(integrator());
  tfm::Model model(scene, timers);
  const std::vector<double> start = volumes(model);
  advance_past_breakpoints(model, 0.3);
  record("ledger", ledger_error(model, start));
  EXPECT_LT(ledger_error(model, start), 1e-12);
  const std::vector<fluid::Passed> passed = model.passed();
  const double exact = integrator() == core::TfmIntegrator::explicit_steps ? 1e-12 : 1e-2, depth = scene.column.size[2];
  EXPECT_NEAR(passed[0].in / (4.4e-6 * depth), 1, exact);
  EXPECT_EQ(passed[1].in, 0);
  const double out = (passed[0].out + passed[1].out) / (4.2e-5 * depth);
  record("solids in what is drawn from the bed", out);
  EXPECT_GT(out, 0.4);
  EXPECT_LT(out, 0.62);
  model.step(1.0);
  model.show(0.5 * (0.3 + model.time()));  // dense output keeps sums, too
  EXPECT_LT(ledger_error(model, start), 1e-12);
}

// A discharge in the bottom beside the left side, through which solids are fed: their faces at the corner have one
// index.
TEST_P(SidePorts, NothingIsLostWhereTwoMeetInACorner) {
  core::Timers timers;
  core::Scene scene = busy_sides(integrator());
  scene.discharges.push_back({ColumnFace::bottom, {0.0}, {0.006}, {{0.0, 0.01}}});
  tfm::Model model(scene, timers);
  const std::vector<double> start = volumes(model);
  advance_past_breakpoints(model, 0.12);
  EXPECT_GT(model.passed()[0].in, 0);
  EXPECT_LT(ledger_error(model, start), 1e-12);
}

// Through the middle third of the bottom a bed is emptied: by 0.01 x 0.01 x 0.5 of the settled bed's fraction at most.
TEST_P(SidePorts, ADischargeInTheBottomEmptiesTheBed) {
  core::Scene scene = binary_bed(9, 20, 0.03, 0.08);
  scene.tfm.integrator = integrator();
  scene.tfm.rtol = 1e-3;
  scene.inlet.superficial_velocity = {{0.0, 0.02}};
  scene.discharges.push_back({ColumnFace::bottom, {0.01}, {0.02}, {{0.0, 0.01}}});
  core::Timers timers;
  tfm::Model model(scene, timers);
  const std::vector<double> start = volumes(model);
  advance_past_breakpoints(model, 0.5);
  EXPECT_LT(ledger_error(model, start), 1e-12);
  const std::vector<fluid::Passed> passed = model.passed();
  EXPECT_EQ(passed[0].in + passed[1].in, 0);
  const double drawn = 0.01 * 0.01 * 0.5 * scene.column.size[2], out = (passed[0].out + passed[1].out) / drawn;
  record("solids in what is drawn through the bottom", out);
  EXPECT_GT(out, 0.4);
  EXPECT_LT(out, 0.62);
}

// Volume that flows upwards over the width: 0.02 of the bottom; above 22 mm 0.4 of the left jet, from 0.1 s on 0.8 ...
TEST_P(SidePorts, EveryLevelCarriesWhatHasComeInBelow) {
  core::Timers timers;
  core::Scene scene = busy_sides(integrator());
  tfm::Model model(scene, timers);
  const core::Grid& grid = model.constants().grid;
  const auto through = [&](int level) {
    double sum = 0;
    for (int i = 0; i < 9; ++i) sum += model.fields().fluid.flux[1][std::size_t(grid.index(i, level))] / 9;
    return sum;
  };
  struct At {
    double time, left, feed, right, above;  // velocities of the ports, m/s
  };
  for (const At& now : {At{0.05, 0.05, 0.002, 0.01, 0}, At{0.3, 0.1, 0.001, 0.04, 0.02}}) {
    advance_past_breakpoints(model, now.time);
    const double bottom = 0.02, jet = bottom + 0.012 / 0.03 * now.left, below_feed = jet - 0.014 / 0.03 * 0.01,
                 fed = below_feed + 0.008 / 0.03 * now.feed,
                 top = fed + 0.005 / 0.03 * now.right - 0.01 / 0.03 * now.above;
    EXPECT_NEAR(through(0), bottom, 1e-14) << now.time;
    EXPECT_NEAR(through(9), below_feed, 1e-6) << now.time;  // at 36 mm
    EXPECT_NEAR(through(20), fed, 1e-6) << now.time;
    EXPECT_NEAR(through(40), top, 1e-6) << now.time;
  }
}

TEST_P(SidePorts, AResumedRunGivesTheSameBits) {
  core::Timers timers;
  const core::Scene scene = busy_sides(integrator());
  tfm::Model through(scene, timers), resumed(scene, timers);
  advance_past_breakpoints(through, 0.12);
  through.restart();
  resumed.resume(through.checkpoint());
  advance_past_breakpoints(through, 0.25);
  advance_past_breakpoints(resumed, 0.25);
  EXPECT_EQ(through.checkpoint().arrays.at("state"), resumed.checkpoint().arrays.at("state"));
  EXPECT_GT(resumed.passed()[1].out, 0);
  EXPECT_EQ(through.passed()[1].out, resumed.passed()[1].out);
}

/// Ports of a scene at the faces opposite to theirs.
void swap_left_and_right(core::Scene& scene) {
  const auto swap = [](auto& parts) {
    for (auto& part : parts)
      part.at = core::face_of(axis_of(part.at), is_side(part.at) ? 1 - side_of(part.at) : side_of(part.at));
  };
  swap(scene.jets);
  swap(scene.feeds);
  swap(scene.discharges);
}

// To round-off over some steps.
TEST_P(SidePorts, LeftAndRightAreMirrorImages) {
  core::Scene scene = busy_sides(integrator());
  scene.tfm.pressure_tolerance = 1e-12;
  scene.effects["fluid_stress"] = "newtonian";
  core::Timers timers;
  tfm::Model one(scene, timers);
  swap_left_and_right(scene);
  tfm::Model other(scene, timers);
  advance_past_breakpoints(one, 0.09);
  advance_past_breakpoints(other, 0.09);
  const core::Grid& grid = one.constants().grid;
  double phi = 0, flux = 0;
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i <= 9; ++i) {
      const auto at = std::size_t(grid.index(i, j)), mirrored = std::size_t(grid.index(9 - i, j)),
                 cell = std::size_t(grid.index(8 - i, j));
      flux = std::max(flux, std::abs(one.fields().fluid.flux[0][at] + other.fields().fluid.flux[0][mirrored]));
      if (i < 9)
        phi = std::max(phi, std::abs(one.fields().solids.fraction[0][at] - other.fields().solids.fraction[0][cell]));
    }
  record("flux less its image, m/s", flux);
  record("fraction less its image", phi);
  EXPECT_LT(flux, 1e-12);
  EXPECT_LT(phi, 1e-12);
}

/// A box of three dimensions with a jet, a feed and a discharge in sides along one axis. \param along_depth  z, or x
core::Scene turned(core::TfmIntegrator integrator, bool along_depth) {
  core::Scene scene = binary_bed(6, 16, 0.03, 0.08);
  scene.column.dimensions = 3;
  scene.column.size = {0.03, 0.08, 0.02};
  scene.column.cells = {6, 16, 4};
  scene.tfm.integrator = integrator;
  scene.tfm.rtol = 1e-3;
  scene.tfm.pressure_tolerance = 1e-12;
  scene.effects["fluid_stress"] = "newtonian";
  scene.jets.push_back({{0.005, 0.01}, {0.013, 0.02}, {{0.0, 0.1}}, ColumnFace::left});
  scene.feeds.push_back({"fine", ColumnFace::left, {{0.0, 0.003}}, 0.05, {0.006, 0.03}, {0.02, 0.04}});
  scene.discharges.push_back({ColumnFace::right, {0.0, 0.012}, {0.012, 0.027}, {{0.0, 0.02}}});
  if (!along_depth) return scene;
  std::swap(scene.column.size[0], scene.column.size[2]);
  std::swap(scene.column.cells[0], scene.column.cells[2]);
  scene.jets[0].at = scene.feeds[0].at = ColumnFace::front;
  scene.discharges[0].at = ColumnFace::back;
  return scene;
}

TEST_P(SidePorts, WidthAndDepthAreAlike) {
  core::Timers timers;
  tfm::Model one(turned(integrator(), false), timers), other(turned(integrator(), true), timers);
  const std::vector<double> start = volumes(one);
  advance_past_breakpoints(one, 0.05);
  advance_past_breakpoints(other, 0.05);
  const core::Grid &grid = one.constants().grid, &swapped = other.constants().grid;
  double phi = 0, flux = 0;
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 6; ++i) {
        const auto at = std::size_t(grid.index(i, j, k)), turned_at = std::size_t(swapped.index(k, j, i));
        phi =
            std::max(phi, std::abs(one.fields().solids.fraction[0][at] - other.fields().solids.fraction[0][turned_at]));
        flux = std::max(flux, std::abs(one.fields().fluid.flux[0][at] - other.fields().fluid.flux[2][turned_at]));
      }
  record("flux across, less the other's, m/s", flux);
  record("fraction less the other's", phi);
  EXPECT_LT(flux, 1e-12);
  EXPECT_LT(phi, 1e-12);
  EXPECT_GT(one.passed()[1].out, 0);
  EXPECT_NEAR(one.passed()[0].in / (0.014 * 0.01 * 0.003 * 0.05), 1, 1e-10);
  EXPECT_LT(ledger_error(one, start), 1e-12);
}

// Air that can be compressed: what its jets bring and the discharge takes is in its account, the solids' too.
TEST(SidePortsOfAGas, AreInItsAccount) {
  for (const char* integrator : {"explicit", "implicit"}) {
    core::Scene scene = uniform_bed(60e-6, 1500, 1.204118, 1.813e-5, 0.3, 16, 0.08);
    scene.column.size[0] = 0.02;
    scene.column.cells[0] = 4;
    scene.column.sides = core::Boundary::wall;
    scene.fluid.equation_of_state = core::Compressibility::ideal_gas;
    scene.fluid.outlet_pressure = 101325;
    scene.bed.static_height = 0.06;
    scene.tfm.max_packing = 0.64;
    scene.inlet.superficial_velocity = {{0.0, 0.2}};
    scene.jets.push_back({{0.01}, {0.02}, {{0.0, 1.0}}, ColumnFace::left});
    scene.feeds.push_back({"solid", ColumnFace::right, {{0.0, 0.02}}, 0.5, {0.01}, {0.02}});
    scene.discharges.push_back({ColumnFace::right, {0.03}, {0.05}, {{0.0, 0.3}}});
    scene.effects = {{"drag", "gidaspow"}, {"solids_stress", "frictional"}};
    scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
    core::Timers timers;
    tfm::Model model(scene, timers);
    const std::vector<double> start = volumes(model);
    advance(model, 0.02);
    const auto account = model.fluid_account(model.time());
    ASSERT_TRUE(account);
    const double error = account->error(fluid::fluid_mass(model.constants().grid, model.fields().fluid));
    record(fmt::format("fluid mass, {}", integrator), error);
    record(fmt::format("in over what was there, {}", integrator), account->in / account->start);
    EXPECT_LT(error, 1e-3);  // the invariant's limit
    EXPECT_GT(account->in, 0.2 * account->start);
    EXPECT_GT(model.passed()[0].out, 0);
    EXPECT_LT(ledger_error(model, start), 1e-12);
  }
}

TEST(SidePortsOfOthers, AreAbsentFromAColumnWithoutThem) {
  core::Scene scene = binary_bed(6, 20, 0.018, 0.06);
  core::Timers timers;
  const auto unknowns = [&] { return tfm::Model(scene, timers).unknowns(); };
  const std::size_t closed = unknowns();
  scene.jets.push_back({{0.0}, {0.01}, {{0.0, 0.1}}, ColumnFace::left});
  EXPECT_EQ(unknowns(), closed);
  scene.feeds.push_back({"fine", ColumnFace::left, {{0.0, 0.001}}, 0.1, {}, {}});
  EXPECT_EQ(unknowns(), closed + 20);
  scene.discharges.push_back({ColumnFace::right, {}, {}, {{0.0, 0.01}}});
  EXPECT_EQ(unknowns(), closed + 20 + 2 * 20);
}

}  // namespace
}  // namespace polybed::scenes
