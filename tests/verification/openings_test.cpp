// Solids that leave through an open outlet and are fed: at the exact rate, counted to round-off, and never from
// nowhere.
#include <gtest/gtest.h>

#include "closures/drag_cello.hpp"
#include "scenes/ledgers.hpp"
#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

class Openings : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Integrators, Openings, testing::Values("explicit", "imex", "implicit"));

constexpr double transport_height = 0.1, transport_fraction = 0.05, transport_flux = 0.06;

/// Upward velocity of 0.2 mm spheres spread evenly in water of 1e-3 Pa s: J = U + eps w, where drag and the net
/// pressure carry the weight, 18 mu f(eps, Re) w/D^2 = (rho_s - rho_f) g; excess = rho_s - rho_f, kg/m3, flux J, m/s.
double transport_velocity(double excess, double flux) {
  const double eps = 1 - transport_fraction;
  double low = 0, high = 1;
  for (int n = 0; n < 200; ++n) {
    const double w = 0.5 * (low + high);
    const double f = closures::DragCello{}(eps, 1000 * eps * w * 0.2e-3 / 1e-3).f;
    (18 * 1e-3 * f * w / (0.2e-3 * 0.2e-3) < std::abs(excess) * 9.81 ? low : high) = w;
  }
  return flux - std::copysign(eps * low, excess);
}

core::Scene transport(const std::string& integrator) {
  core::Scene scene = uniform_bed(0.2e-3, 2200, 1000, 1e-3, transport_fraction, 20, transport_height);
  scene.column.outlet = core::Outlet::open;
  scene.inlet.superficial_velocity = {{0.0, transport_flux}};
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
  scene.tfm.rtol = 1e-5;
  return scene;
}

/// Solids flux through the outlet between two times, m/s.
double outflow(tfm::Model& model, double from, double to) {
  advance(model, from);
  const double before = model.passed()[0].out;
  advance(model, to);
  const core::Grid& grid = model.constants().grid;
  return (model.passed()[0].out - before) / (to - from) / (grid.spacing[0] * grid.spacing[2]);
}

// Fed at the rate and the velocity at which they travel, they stay evenly spread: in at the bottom, out at the top.
TEST_P(Openings, ATransportColumnPassesOnWhatItIsFed) {
  core::Scene scene = transport(GetParam());
  const double velocity = transport_velocity(1200, transport_flux), flux = transport_fraction * velocity;
  scene.inlet.superficial_velocity = {{0.0, transport_flux - flux}};
  scene.feeds.push_back({"solid", core::ColumnFace::bottom, {{0.0, flux}}, velocity, {}, {}});
  core::Timers timers;
  tfm::Model model(scene, timers);
  const std::vector<double> start = volumes(model);
  const double out = outflow(model, 8, 9);  // after four passages
  record("flux out over flux in, less 1", out / flux - 1);
  EXPECT_NEAR(out / flux, 1, 10 * scene.tfm.rtol);
  double uneven = 0;
  const core::Grid& grid = model.constants().grid;
  for (int k = 0; k < 20; ++k) {
    const double phi = model.fields().solids.fraction[0][std::size_t(grid.index(0, k))];
    uneven = std::max(uneven, std::abs(phi / transport_fraction - 1));
  }
  record("greatest relative departure from the even fraction", uneven);
  EXPECT_LT(uneven, 10 * scene.tfm.rtol);
  record("ledger", ledger_error(model, start));
  EXPECT_LT(ledger_error(model, start), 1e-12);
}

// Not fed, they leave at the same rate until their rear, which rises at their velocity, nears the top: 2 s here.
TEST_P(Openings, FinesAreCarriedOutAtTheRateAtWhichTheyTravel) {
  core::Timers timers;
  tfm::Model model(transport(GetParam()), timers);
  const std::vector<double> start = volumes(model);
  const double expected = transport_fraction * transport_velocity(1200, transport_flux), out = outflow(model, 0.1, 0.9);
  record("flux out over phi U, less 1", out / expected - 1);
  EXPECT_NEAR(out / expected, 1, 1e-4);  // ten times rtol
  advance(model, 5);
  EXPECT_LT(ledger_error(model, start), 1e-12);
  EXPECT_GT(model.passed()[0].out, 0.9 * start[0]);
}

// The mirror image of settling: light spheres rise through water that is still, J = 0, and leave; water takes their
// place through the same faces, and brings none back.
TEST_P(Openings, LightSolidsRiseOutOfStillWater) {
  core::Scene scene = transport(GetParam());
  scene.species[0].density = 600;
  scene.inlet.superficial_velocity = {{0.0, 0.0}};
  core::Timers timers;
  tfm::Model model(scene, timers);
  const std::vector<double> start = volumes(model);
  const double expected = transport_fraction * transport_velocity(-400, 0), out = outflow(model, 1, 4);
  record("flux out over phi U, less 1", out / expected - 1);
  EXPECT_NEAR(out / expected, 1, 1e-4);  // ten times rtol
  EXPECT_LT(ledger_error(model, start), 1e-12);
}

/// Everything at once: two species, an outlet open to them, a feed from below beside a jet, one from above in a part.
core::Scene busy(const std::string& integrator) {
  core::Scene scene = binary_bed(9, 40, 0.03, 0.16);
  scene.column.outlet = core::Outlet::open;
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
  scene.tfm.rtol = 1e-3;
  scene.tfm.pressure_tolerance = 1e-8;
  scene.bed.start_solids_fraction = 0.5;
  scene.inlet.superficial_velocity = {{0.0, 0.0}};
  scene.jets.push_back({{0.01}, {0.02}, {{0.0, 0.09}, {0.1, 0.09}, {0.1, 0.18}}});
  scene.jets.push_back({{0.0}, {0.005}, {{0.0, 0.03}, {0.2, 0.06}}});
  scene.feeds.push_back({"fine",
                         core::ColumnFace::bottom,
                         {{0.0, 0.0}, {0.1, 0.004}, {0.15, 0.004}, {0.15, 0.001}},
                         0.05,
                         {0.012},
                         {0.02}});
  scene.feeds.push_back({"coarse", core::ColumnFace::top, {{0.0, 0.001}}, 0.06, {0.005}, {0.0125}});
  return scene;
}

// By hand: fine 0.008 x (0.5 x 0.1 x 0.004 + 0.05 x 0.004 + 0.15 x 0.001) = 4.4e-6 m2, coarse 0.0075 x 0.001 x 0.3 =
// 2.25e-6 m2, times the depth. Runge-Kutta of order 3 integrates a ramp exactly; backward differences do not, but what
// they count is what they let in.
TEST_P(Openings, TheLedgerClosesWhateverTheSteps) {
  core::Timers timers;
  const core::Scene scene = busy(GetParam());
  tfm::Model model(scene, timers);
  const std::vector<double> start = volumes(model);
  advance_past_breakpoints(model, 0.3);
  record("ledger", ledger_error(model, start));
  EXPECT_LT(ledger_error(model, start), 1e-12);
  const std::vector<fluid::Passed> passed = model.passed();
  const double exact = scene.tfm.integrator == core::TfmIntegrator::explicit_steps ? 1e-12 : 1e-2,
               depth = scene.column.size[2];
  EXPECT_NEAR(passed[0].in / (4.4e-6 * depth), 1, exact);
  EXPECT_NEAR(passed[1].in / (2.25e-6 * depth), 1, 1e-12);
  model.step(1.0);
  model.show(0.5 * (0.3 + model.time()));  // dense output keeps sums, too
  EXPECT_LT(ledger_error(model, start), 1e-12);
}

// The flux through every level is that of the fluid and of the solids fed below it, in time: at 0.05, 0.12, 0.3 s
// (0.01 x 0.09 + 0.005 x 0.0375 + 0.008 x 0.002)/0.03 and so on.
TEST_P(Openings, EveryLevelCarriesTheFluidAndTheSolidsThatFlowIn) {
  core::Timers timers;
  tfm::Model model(busy(GetParam()), timers);
  const core::Grid& grid = model.constants().grid;
  const auto through = [&](int level) {
    double sum = 0;
    for (int i = 0; i < 9; ++i) sum += model.fields().fluid.flux[1][std::size_t(grid.index(i, level))] / 9;
    return sum;
  };
  const auto expected = [](double jet, double other, double feed) {
    return (0.01 * jet + 0.005 * other + 0.008 * feed) / 0.03;
  };
  const std::vector<std::pair<double, double>> flux{
      {0.05, expected(0.09, 0.0375, 0.002)}, {0.12, expected(0.18, 0.048, 0.004)}, {0.3, expected(0.18, 0.06, 0.001)}};
  for (const auto& [t, j] : flux) {
    advance_past_breakpoints(model, t);
    EXPECT_NEAR(through(0), j, 1e-14) << t;
    for (const int level : {1, 20, 40}) EXPECT_NEAR(through(level), j, 1e-6) << t << " " << level;
  }
}

TEST_P(Openings, AResumedRunGivesTheSameBits) {
  core::Timers timers;
  const core::Scene scene = busy(GetParam());
  tfm::Model through(scene, timers), resumed(scene, timers);
  advance_past_breakpoints(through, 0.12);
  through.restart();
  resumed.resume(through.checkpoint());
  advance_past_breakpoints(through, 0.25);
  advance_past_breakpoints(resumed, 0.25);
  EXPECT_EQ(through.checkpoint().arrays.at("state"), resumed.checkpoint().arrays.at("state"));
  EXPECT_GT(resumed.passed()[0].in, 0);
  EXPECT_EQ(through.passed()[0].in, resumed.passed()[0].in);
  EXPECT_EQ(through.passed()[1].out, resumed.passed()[1].out);
}

// A column full of solids whose fluid flows down: everything at the outlet moves inwards, and nothing comes with it.
void expect_nothing_in(const std::string& integrator, const std::string& momentum) {
  core::Scene scene = uniform_bed(0.2e-3, 2200, 1000, 1e-3, 0.2, 20, 0.1);
  scene.effects["solids_stress"] = "frictional";
  scene.tfm.max_packing = 0.64;
  scene.column.outlet = core::Outlet::open;
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
  scene.scheme.momentum = core::choice_of<core::Momentum>(momentum);
  scene.tfm.rtol = 1e-3;
  scene.inlet.superficial_velocity = {{0.0, -0.01}};
  core::Timers timers;
  tfm::Model model(scene, timers);
  const std::vector<double> start = volumes(model);
  advance(model, 1.0);
  EXPECT_EQ(model.passed()[0].out, 0);
  EXPECT_EQ(model.passed()[0].in, 0);
  EXPECT_LT(ledger_error(model, start), 1e-12);
  const core::Grid& grid = model.constants().grid;
  EXPECT_LT(model.fields().solids.velocity[0][1][std::size_t(grid.index(0, 20))], -0.01);
  EXPECT_NEAR(model.fields().solids.fraction[0][std::size_t(grid.index(0, 19))], 0, 0.01);
}

TEST_P(Openings, NothingComesInThroughTheOutlet) {
  for (const char* momentum : {"conservative", "conservative_limited"}) expect_nothing_in(GetParam(), momentum);
}

// Solids in above, fluid below, around the velocity that carries them: what falls is stored, what does not is thrown
// out beside the feed, and together they are what was fed.
TEST_P(Openings, NearFloodingNoSolidsComeFromNowhere) {
  for (const double velocity : {0.08, 0.115, 0.15}) {
    core::Scene scene = binary_bed(8, 30, 0.032, 0.12);
    scene.species[0] = {"heavy", 0.8e-3, {}, 2200, 1, 0.64, {}, {}, {}, {}};
    scene.species[1] = {"seed", 2.0e-3, {}, 4000, 1, 0.64, {}, {}, {}, {}};
    scene.bed.volume_share = {0.0, 1.0};
    scene.bed.static_height = 0.01;
    scene.effects.erase("species_exchange");
    scene.column.outlet = core::Outlet::open;
    scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(GetParam());
    scene.tfm.rtol = 1e-3;
    scene.inlet.superficial_velocity = {{0.0, velocity}};
    scene.feeds.push_back({"heavy", core::ColumnFace::top, {{0.0, 0.0}, {0.1, 0.005}}, 0.1, {0.008}, {0.02}});
    core::Timers timers;
    tfm::Model model(scene, timers);
    const std::vector<double> start = volumes(model);
    advance_past_breakpoints(model, 2.0);
    const fluid::Passed heavy = model.passed()[0];
    record(fmt::format("thrown out at {} m/s", velocity), heavy.out / heavy.in);
    record(fmt::format("ledger at {} m/s", velocity), ledger_error(model, start));
    EXPECT_LT(ledger_error(model, start), 1e-12) << velocity;
    EXPECT_GE(heavy.out, 0) << velocity;
    EXPECT_LE(heavy.out, heavy.in) << velocity;
    EXPECT_EQ(model.passed()[1].in, 0);
    double least = 0;
    core::for_each_row(model.constants().grid, [&](core::Index begin, core::Index end) {
      for (core::Index c = begin; c < end; ++c)
        least = std::min(least, model.fields().solids.fraction[0][std::size_t(c)]);
    });
    EXPECT_GE(least, -scene.tfm.rtol) << velocity;  // ten absolute tolerances
  }
}

TEST(OpeningsOfAScreen, CostNothing) {
  core::Scene scene = binary_bed(6, 20, 0.018, 0.06);
  core::Timers timers;
  const auto unknowns = [&] { return tfm::Model(scene, timers).unknowns(); };
  const std::size_t closed = unknowns();
  EXPECT_EQ(closed, 2U * 120 + 3U * (7 * 20 + 6 * 21));
  scene.feeds.push_back({"fine", core::ColumnFace::bottom, {{0.0, 0.001}}, 0.1, {}, {}});
  EXPECT_EQ(unknowns(), closed + 6);
  scene.column.outlet = core::Outlet::open;
  EXPECT_EQ(unknowns(), closed + 6 + 12);
}

}  // namespace
}  // namespace polybed::scenes
