// Beds and flow in cones and steps: at rest, fluidised, fed and emptied.
#include "measures/bed.hpp"
#include "scenes/round_beds.hpp"

namespace polybed::scenes {
namespace {

using core::ColumnShape;
constexpr double radius = tube_radius, height = tube_height;

/// Diameters in m over heights in m: a cone that widens, a tube, a step inwards and one outwards.
const core::Taper cone{{0, 0.016}, {0.07, 2 * radius}, {height, 2 * radius}},
    steps{{0, 2 * radius}, {0.03, 2 * radius}, {0.03, 0.02}, {0.06, 0.018}, {0.06, 2 * radius}, {height, 0.02}};

class TaperedBed : public testing::TestWithParam<RoundCase> {
 protected:
  static core::Scene scene(const core::Taper& profile) { return GetParam().scene(profile); }
};
INSTANTIATE_TEST_SUITE_P(Shapes, TaperedBed, round_cases);

// A millionth of the velocity at which the fine fall, 23 mm/s, and of the weight of the bed.
TEST_P(TaperedBed, RestsWhereItHasSettled) {
  for (const core::Taper& profile : {cone, steps}) {
    core::Scene scene = settled_alone(TaperedBed::scene(profile));
    scene.effects["fluid_stress"] = "newtonian";
    const Finished run(scene, 0.2);
    record("greatest flux of solids, m/s", greatest_flux(run));
    EXPECT_LT(greatest_flux(run), 2.3e-8);
    const double weight = 0.62 * scene.bed.static_height * (1395 - 999) * 9.81;
    double most = 0;  // net of the weight of the fluid: 0 where it is hydrostatic
    core::for_each_row(run.grid(), [&](core::Index begin, core::Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c)
        if (run.grid().metric->volume[c] > 0) most = std::max(most, std::abs(run.model.fields().fluid.pressure[c]));
    });
    record("greatest net pressure, of the weight", most / weight);
    EXPECT_LT(most, 1e-6 * weight);
  }
}

// Fluid alone, as much through every level as through the bottom, and evenly where the tube is even again: to what the
// pressure's solver leaves, 1e-10 of its source, after some 1e2 steps.
TEST_P(TaperedBed, LetsAsMuchFluidThroughEveryLevel) {
  using enum core::ColumnEnd;
  for (const auto& [profile, at] : {std::pair{cone, bottom}, std::pair{steps, bottom}, std::pair{cone, top}}) {
    core::Scene scene = TaperedBed::scene(profile);
    scene.inlet.at = at;
    scene.bed.static_height = 0;
    scene.effects["fluid_stress"] = "newtonian";
    const Finished run(scene, 0.2);
    const double worst = uneven_flow(run, 0.03 * std::numbers::pi / 4 * std::pow(profile.front().second, 2));
    record("greatest difference from what flows in", worst);
    EXPECT_LT(worst, 1e-8);
  }
}

// In compressible water the cells that the wall closes keep their pressure, and of the water nothing is lost, within
// the tolerance.
TEST(TaperedBedInCompressibleWater, KeepsThePressureOfClosedCells) {
  for (const ColumnShape shape : {ColumnShape::axisymmetric, ColumnShape::cylinder}) {
    core::Scene scene = tube(shape, cone);
    scene.fluid.equation_of_state = core::Compressibility::tait;
    scene.tfm.integrator = core::TfmIntegrator::implicit_steps;
    core::Timers timers;
    tfm::Model model(scene, timers);
    const core::Field &p = model.fields().fluid.pressure, &theta = model.constants().grid.metric->volume;
    model.show(0);
    const core::Field start = p;
    advance(model, 0.05);
    std::size_t closed = 0;
    core::for_each_row(model.constants().grid, [&](core::Index begin, core::Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
        if (theta[c] > 0) continue;
        ++closed;
        EXPECT_EQ(p[c], start[c]);
      }
    });
    EXPECT_GT(closed, 0);
    const double lost =
        model.fluid_account(0.05)->error(fluid::fluid_mass(model.constants().grid, model.fields().fluid));
    record("water not accounted for", lost);
    EXPECT_LT(lost, scene.tfm.rtol);
  }
}

// Fed on a part of the bottom, whose area is known, and open above: the ledger closes to round-off.
TEST_P(TaperedBed, CountsWhatEntersAndLeaves) {
  core::Scene scene = TaperedBed::scene(cone);
  const bool rings = scene.column.around_axis();
  scene.column.outlet = core::Outlet::open;
  scene.tfm.rtol = 1e-3;
  scene.inlet.superficial_velocity = {{0.0, 0.06}};
  const std::vector<double> low = rings ? std::vector{0.001} : std::vector{0.0115, 0.0115},
                            high = rings ? std::vector{0.008} : std::vector{0.017, 0.018};  // over cells that are cut
  scene.feeds.push_back({"fine", core::ColumnFace::bottom, {{0.0, 0.004}}, 0.05, low, high});
  const double area = rings ? std::numbers::pi * (0.008 * 0.008 - 0.001 * 0.001) : 0.0055 * 0.0065;
  // Of the frustum below 48 mm, 16 to 25.6 mm across, whatever the cells.
  const double frustum = std::numbers::pi / 12 * 0.048 * (0.016 * 0.016 + 0.016 * 0.0256 + 0.0256 * 0.0256);
  expect_a_closed_ledger(scene, 0.569 * 0.62 * frustum, area * 0.004 * 0.2);
}

// A cone of no angle is the tube: to what the pressure's solvers, 1e-10 of their source, leave over 100 steps of one
// length, and to the tolerance of the implicit steps.
TEST_P(TaperedBed, OfOneDiameterIsThatOfATube) {
  core::Scene with = scene({{0, 2 * radius}, {0.05, 2 * radius}, {height, 2 * radius}});
  with.effects["fluid_stress"] = "newtonian";
  if (with.tfm.integrator != core::TfmIntegrator::implicit_steps) with.tfm.fixed_step = 1e-3;
  core::Scene without = with;
  without.column.profile.clear();
  const double apart = difference(Finished(with, 0.1), Finished(without, 0.1));
  record("greatest difference of the fine's fraction", apart);
  EXPECT_LT(apart, with.tfm.fixed_step ? 1e-8 : 10 * with.tfm.rtol);
}

/// Upward force of a pressure on what flows, by the open faces between layers, N: that on the bottom and on sloping
/// walls.
double lift_of(const core::Grid& grid, const core::Field& pressure, bool to_the_ends) {
  const core::Index s = grid.stride(1);
  const int top = grid.cells[1];
  double force = 0;
  for (int j = to_the_ends ? 0 : 1; j < (to_the_ends ? top + 1 : top); ++j)
    for (int i = 0; i < grid.cells[0]; ++i) {
      const core::Index f = grid.index(i, j), from = j == 0 ? f : f - s, to = j == 0 ? f + s : f;
      const double fall = pressure[std::size_t(from)] - (j == top ? 0 : pressure[std::size_t(to)]);
      force += grid.metric->open[1][std::size_t(f)] * (j == 0 ? 0.5 : 1) * fall;
    }
  return force * grid.spacing[0] * grid.spacing[2];
}

// A bed of the coarse that the fluid carries through a cone: bottom and wall press upwards with what the solids weigh,
// through the fluid and, where they are packed above, the solids. The rest, 1.5 %, is the momentum of what goes round.
TEST(TaperedColumn, CarriesABedWithThePressureOfItsWall) {
  core::Scene scene = tube(ColumnShape::axisymmetric, cone);
  scene.species.erase(scene.species.begin());
  scene.effects.erase("species_exchange");
  scene.bed.volume_share = {1.0};
  scene.inlet.superficial_velocity = {{0.0, 0.06}};
  scene.tfm.integrator = core::TfmIntegrator::split_steps;
  core::Timers timers;
  tfm::Model model(scene, timers);
  const core::Grid& grid = model.constants().grid;
  double fluid = 0, solids = 0, weight = 0, drop = 0, over_area = 0;
  for (int n = 1; n <= 40; ++n) {
    advance(model, 3 + 0.05 * n);
    const tfm::Fields& fields = model.fields();
    const double load = (1170 - model.constants().fluid.density) * 9.81;
    fluid += lift_of(grid, fields.fluid.pressure, true);
    solids += lift_of(grid, fields.stress.pressure, false);
    weight += measures::species_volumes(grid, fields.solids)[0] * load;
    const std::vector<double> phi = measures::lateral_mean(grid, fields.solids.fraction[0]);
    const measures::Profile profile{grid.spacing[1], {phi}, measures::lateral_mean(grid, fields.fluid.pressure)};
    drop += measures::pressure_drop(profile);
    for (const double one : phi) over_area += one * grid.spacing[1] * load;
  }
  record("force of the fluid, of the weight", fluid / weight);
  record("force of the solids, of the weight", solids / weight);
  record("pressure drop, of the weight over the local cross-section", drop / over_area);
  EXPECT_NEAR((fluid + solids) / weight, 1, 0.02);
}

/// Fall of the mean pressure of a fluid without viscosity that a cone narrows from 30 to 16 mm, in its tubes, over
/// Bernoulli's rho (u2^2 - u1^2)/2, less 1.
double excess_over_bernoulli(int rings) {
  core::Scene scene =
      tube(ColumnShape::axisymmetric, {{0, 2 * radius}, {0.03, 2 * radius}, {0.08, 0.016}, {height, 0.016}});
  scene.column.cells = {rings, 8 * rings, 1};
  scene.bed.static_height = 0;
  scene.inlet.superficial_velocity = {{0.0, 0.03}};
  scene.tfm.integrator = core::TfmIntegrator::split_steps;
  const Finished run(scene, 4);
  const std::vector<double> p = measures::lateral_mean(run.grid(), run.model.fields().fluid.pressure);
  const double narrow = 0.03 * std::pow(2 * radius / 0.016, 2);
  const double fall = p[std::size_t(rings)] - p[std::size_t(7 * rings)];
  return fall / (run.model.constants().fluid.density * (narrow * narrow - 0.03 * 0.03) / 2) - 1;
}

// The wall is stairs of cells: what flows up a ring that it closes turns inwards within a layer, and the kinetic energy
// of that motion, of the ring's last 0.15, is lost at every stair. 5 % at 8 rings, 4 at 16 and at 32.
TEST(TaperedColumn, LetsThePressureFallAsBernoulliSays) {
  const double coarse = excess_over_bernoulli(8), fine = excess_over_bernoulli(16);
  record("excess, 8 rings", coarse);
  record("excess, 16 rings", fine);
  EXPECT_LT(std::abs(coarse), 0.08);
  EXPECT_LT(std::abs(fine), 0.05);
}

// Taken up again half-way it has the same bits.
TEST_P(TaperedBed, GoesOnFromACheckpoint) {
  core::Scene scene = TaperedBed::scene(cone);
  scene.tfm.rtol = 1e-3;
  const TwoEnds ends = through_and_resumed(scene, 0.04, 0.08);
  EXPECT_EQ(ends.through.arrays, ends.resumed.arrays);
}

}  // namespace
}  // namespace polybed::scenes
