// Beds in round columns: at rest, rising, fed and emptied, and turned by a quarter.
#include "scenes/round_beds.hpp"

namespace polybed::scenes {
namespace {

using core::ColumnShape;
constexpr double radius = tube_radius;

/// A box of one row of cells with the tube's cross-section.
core::Scene box_of(core::Scene scene) {
  scene.column.shape = ColumnShape::box;
  scene.column.dimensions = 2;
  scene.column.cells = {1, 32, 1};
  scene.column.size = {radius, 0.12, std::numbers::pi * radius};
  return scene;
}

class RoundBed : public testing::TestWithParam<RoundCase> {
 protected:
  static core::Scene scene() { return GetParam().scene(); }
};
INSTANTIATE_TEST_SUITE_P(Shapes, RoundBed, round_cases);

// A millionth of the velocity at which the fine fall, 23 mm/s.
TEST_P(RoundBed, RestsWhereItHasSettled) {
  const Finished run(settled_alone(scene()), 0.2);
  record("greatest flux of solids, m/s", greatest_flux(run));
  EXPECT_LT(greatest_flux(run), 2.3e-8);
}

// Where no wall rubs an even bed stays even, and rises as it does in a box: to what the pressure's solver, 1e-10 of its
// source, leaves over 100 steps of one length, and to the tolerance of the others.
TEST_P(RoundBed, RisesEvenlyAsInABox) {
  core::Scene round = scene();
  if (round.tfm.integrator != core::TfmIntegrator::implicit_steps) round.tfm.fixed_step = 1e-3;
  const Finished in_tube(round, 0.1), in_box(box_of(round), 0.1);
  const double apart = difference(in_tube, in_box);
  record("greatest difference of the fine's fraction", apart);
  EXPECT_LT(apart, round.tfm.fixed_step ? 1e-8 : 10 * round.tfm.rtol);
}

// The same in water with its sound: of the water, too, what has come in and not left is there, within the tolerance.
TEST(RoundBedInCompressibleWater, RisesEvenlyAsInABox) {
  for (const ColumnShape shape : {ColumnShape::axisymmetric, ColumnShape::cylinder}) {
    core::Scene round = tube(shape);
    round.fluid.equation_of_state = core::Compressibility::tait;
    round.tfm.integrator = core::TfmIntegrator::implicit_steps;
    const Finished in_tube(round, 0.1), in_box(box_of(round), 0.1);
    const double apart = difference(in_tube, in_box);
    const double lost =
        in_tube.model.fluid_account(0.1)->error(fluid::fluid_mass(in_tube.grid(), in_tube.model.fields().fluid));
    record("greatest difference of the fine's fraction", apart);
    record("water not accounted for", lost);
    EXPECT_LT(apart, 10 * round.tfm.rtol);
    EXPECT_LT(lost, round.tfm.rtol);
  }
}

// Fed on a part of the bottom and of the top, whose areas are known, and open above: the ledger closes to round-off.
TEST_P(RoundBed, CountsWhatEntersAndLeaves) {
  core::Scene scene = RoundBed::scene();
  const bool rings = scene.column.around_axis();
  scene.column.outlet = core::Outlet::open;
  scene.tfm.rtol = 1e-3;
  scene.inlet.superficial_velocity = {{0.0, 0.06}};
  const std::vector<double> low = rings ? std::vector{0.004} : std::vector{0.0045, 0.0045},  // over cells that are cut
      high = rings ? std::vector{0.008} : std::vector{0.009, 0.01};
  scene.feeds.push_back({"fine", core::ColumnFace::bottom, {{0.0, 0.004}}, 0.05, low, high});
  const double area = rings ? std::numbers::pi * (0.008 * 0.008 - 0.004 * 0.004) : 0.0045 * 0.0055;
  // The bed is solids_fraction times its settled height over the circle, whatever the cells.
  expect_a_closed_ledger(scene, 0.569 * 0.62 * 0.048 * std::numbers::pi * radius * radius, area * 0.004 * 0.2);
}

// The solids of a box, on the same grid, have no place in cells that the wall closes, nor any motion on its faces.
TEST(RoundColumnOfCutCells, TakesNothingBeyondItsWallFromABox) {
  core::Scene round = tube(ColumnShape::cylinder), box = round;
  box.column.shape = ColumnShape::box;
  Finished from(box, 0.05);
  from.model.restart();
  Finished to(round, 0);
  to.model.start_from(from.model.checkpoint());
  to.model.show(0);
  double most = 0, closed = 0;
  core::for_each_row(to.grid(), [&](core::Index begin, core::Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c)
      (to.grid().metric->volume[c] > 0 ? most : closed) += to.phi(0)[c];
  });
  EXPECT_GT(most, 1);
  EXPECT_EQ(closed, 0);
}

/// A jet beside the centre, along x or along z.
core::Scene with_jet(bool along_z) {
  core::Scene scene = tube(ColumnShape::cylinder);
  scene.tfm.fixed_step = 1e-3;
  scene.effects["fluid_stress"] = "newtonian";
  std::vector<double> low{0.013, 0.006}, high{0.017, 0.011};
  if (!along_z) {
    std::swap(low[0], low[1]);
    std::swap(high[0], high[1]);
  }
  scene.jets.push_back({low, high, {{0.0, 0.2}}});
  return scene;
}

// As much through every level: to what the pressure's solver leaves, 1e-10 of its source, after some steps. 12 cells
// across, for which the implicit steps take multigrid; then a start from it with another inflow.
TEST(RoundColumnOfCutCells, LetsAsMuchThroughBetweenTwoDistributors) {
  for (const char* integrator : {"explicit", "imex", "implicit"}) {
    core::Scene scene = tube(ColumnShape::cylinder);
    scene.column.cells = {12, 20, 12};
    scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
    scene.inlet = {{{0.0, 0.02}}, {}, core::ColumnEnd::top};
    const Finished run(scene, 0.02);
    const double area = std::numbers::pi * radius * radius;
    record(std::string("uneven flow, ") + integrator, uneven_flow(run, 0.02 * area));
    EXPECT_LT(uneven_flow(run, 0.02 * area), 1e-8);
    scene.inlet.superficial_velocity = {{0.0, 0.03}};
    Finished other(scene, 0);
    other.model.start_from(run.model.checkpoint());
    advance(other.model, 0.01);
    EXPECT_LT(uneven_flow(other, 0.03 * area), 1e-8) << integrator;
  }
}

// The tube is the same turned by a quarter: round-off of sums in another order, amplified over 100 steps.
TEST(RoundColumnOfCutCells, KnowsNoDirection) {
  const Finished one(with_jet(false), 0.1), other(with_jet(true), 0.1);
  double apart = 0, uneven = 0;
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < 8; ++i) {
        const double here = one.phi(0)[std::size_t(one.grid().index(i, j, k))];
        apart = std::max(apart, std::abs(here - other.phi(0)[std::size_t(other.grid().index(k, j, i))]));
        uneven = std::max(uneven, std::abs(here - one.phi(0)[std::size_t(one.grid().index(k, j, i))]));
      }
  record("greatest difference of the fine's fraction", apart);
  EXPECT_LT(apart, 1e-9);
  EXPECT_GT(uneven, 0.01);  // the jet does something
}

}  // namespace
}  // namespace polybed::scenes
