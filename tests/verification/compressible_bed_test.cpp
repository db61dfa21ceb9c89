// A compressible fluid with solids: a gas through a packed bed, a fluidised bed, the limit of no compressibility.
#include <gtest/gtest.h>

#include <tuple>

#include "core/numerics/operators.hpp"
#include "measures/bed.hpp"
#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

double fluid_error(const tfm::Model& model) {
  return model.fluid_account(model.time())->error(fluid::fluid_mass(model.constants().grid, model.fields().fluid));
}

/// Height of the centre of the first species, m.
double centre(const tfm::Model& model) {
  const core::Grid& grid = model.constants().grid;
  const std::vector<double> phi = measures::lateral_mean(grid, model.fields().solids.fraction[0]);
  double sum = 0, moment = 0;
  for (std::size_t j = 0; j < phi.size(); ++j) {
    sum += phi[j];
    moment += phi[j] * grid.centre(1, int(j));
  }
  return moment / sum;
}

struct Darcy {
  double ratio = 0;   ///< of the pressures at the ends of what is compared
  double error = 0;   ///< relative, of the loss of pressure
  double uneven = 0;  ///< greatest relative difference of the mass flux from that in the middle
};

// Air, 1.8e-5 Pa s, through 1 m of immovable spheres of 0.2 mm at eps 0.40. With Ergun's A = 150 mu (1-eps)^2/(eps^3
// D^2) and B = 1.75 (1-eps)/(eps^3 D), a constant mass flux G and P = rho R T, the momentum of the gas integrates to
//   (P_1^2 - P_2^2)/2 - R T (G/eps)^2 ln(P_1/P_2) = R T (A G + B G^2) L
// between any two heights: density, drag's Reynolds number, continuity and inertia are all local in it.
Darcy gas_through_a_packed_bed(int cells) {
  constexpr double gas_rt = 84148.7, mu = 1.8e-5, eps = 0.4, diameter = 0.2e-3, density = 101325 / gas_rt;
  core::Scene scene = uniform_bed(diameter, 1e15, density, mu, 1 - eps, cells, 1.0);
  scene.fluid.equation_of_state = core::Compressibility::ideal_gas;
  scene.effects["drag"] = "ergun";
  scene.column.gravity = 0;
  scene.inlet.superficial_velocity = {{0.0, 0.2}};
  scene.tfm.integrator = core::TfmIntegrator::implicit_steps;
  scene.tfm.rtol = 1e-6;
  core::Timers timers;
  tfm::Model model(scene, timers);
  advance(model, 10.0);  // the pressure spreads at P k/(mu eps), 1 m2/s: forty times what it needs
  const core::Grid& grid = model.constants().grid;
  const fluid::FluidState& fluid = model.fields().fluid;
  const auto at = [&](int j) { return std::size_t(grid.index(0, j)); };
  const auto flux = [&](int j) {
    const auto c = core::Index(at(j));
    return core::face_mean(fluid.compression.density.data(), c, grid.stride(1)) * fluid.flux[1][at(j)];
  };
  const int first = cells / 10, last = 9 * cells / 10;
  const double g = flux(cells / 2), low = 101325 + fluid.pressure[at(first)], high = 101325 + fluid.pressure[at(last)];
  const double a = 150 * mu * (1 - eps) * (1 - eps) / (eps * eps * eps * diameter * diameter);
  const double b = 1.75 * (1 - eps) / (eps * eps * eps * diameter), length = (last - first) * grid.spacing[1];
  const double lost = (low * low - high * high) / 2 - gas_rt * g * g / (eps * eps) * std::log(low / high);
  Darcy result{low / high, std::abs(lost / (gas_rt * (a * g + b * g * g) * length) - 1), 0};
  for (int j = 0; j <= cells; ++j) result.uneven = std::max(result.uneven, std::abs(flux(j) / g - 1));
  return result;
}

TEST(CompressibleBed, GasThroughAPackedBedLosesPressureInSquares) {
  const Darcy coarse = gas_through_a_packed_bed(50), fine = gas_through_a_packed_bed(100);
  record("pressure ratio", fine.ratio);
  record("relative difference, 50", coarse.error);
  record("relative difference, 100", fine.error);
  record("mass flux", fine.uneven);
  EXPECT_GT(fine.ratio, 1.5);
  EXPECT_LT(std::max(coarse.uneven, fine.uneven), 1e-6);  // the steps' tolerance
  EXPECT_LT(fine.error, 1e-5);                            // of the grid: it falls with the cells
  EXPECT_LT(fine.error, 0.6 * coarse.error);
}

/// A small bed of system B, settled loosely, in water that is stiff to its true speed of sound or wholly.
double centre_of_the_fine(const char* law, double& error) {
  core::Scene scene = binary_bed(6, 20, 0.03, 0.1);
  scene.fluid.equation_of_state = core::choice_of<core::Compressibility>(law);
  scene.tfm.integrator = core::TfmIntegrator::implicit_steps;
  core::Timers timers;
  tfm::Model model(scene, timers);
  advance(model, 1.0);
  error = model.fluid_account(1.0) ? fluid_error(model) : 0;
  return centre(model);
}

TEST(CompressibleBed, WaterOfTheTrueSoundSpeedMovesTheBedLikeAnIncompressibleOne) {
  double error = 0;
  const double incompressible = centre_of_the_fine("incompressible", error), tait = centre_of_the_fine("tait", error);
  record("incompressible, mm", 1e3 * incompressible);
  record("difference, mm", 1e3 * (tait - incompressible));
  record("fluid mass", error);
  EXPECT_NEAR(tait, incompressible, 1e-4 * incompressible);  // rtol
}

/// Glass of 0.5 mm in air at 0.5 m/s, 2.5 times what lifts it, 12 x 48 cells of 2.5 mm.
core::Scene gas_bed(const char* law) {
  core::Scene scene = uniform_bed(0.5e-3, 2500, 1.204118, 1.813e-5, 0.6, 48, 0.12);
  scene.column.size[0] = 0.03;
  scene.column.cells[0] = 12;
  scene.column.sides = core::Boundary::wall;
  scene.fluid.equation_of_state = core::choice_of<core::Compressibility>(law);
  scene.bed.static_height = 0.05;
  scene.bed.start_solids_fraction = 0.55;
  scene.inlet.superficial_velocity = {{0.0, 0.5}};
  scene.effects = {{"drag", "gidaspow"}, {"solids_stress", "frictional"}};
  scene.tfm.integrator = core::TfmIntegrator::implicit_steps;
  scene.tfm.rtol = 1e-3;
  return scene;
}

// The bed's weight of 735 Pa makes the gas 0.7 % denser at the distributor than at the outlet, and so much slower
// through the bed: until the first bubbles, which part any two runs, it expands like that of an incompressible gas
// within a few per cent of what it expands by.
TEST(CompressibleBed, AGasFluidisedBedExpandsAndKeepsBothMasses) {
  core::Timers timers;
  tfm::Model gas(gas_bed("ideal_gas"), timers), incompressible(gas_bed("incompressible"), timers);
  const double volume = measures::species_volumes(gas.constants().grid, gas.fields().solids)[0];
  gas.show(0);
  const double start = centre(gas);
  advance(gas, 0.06);
  advance(incompressible, 0.06);
  const double rise = centre(gas) - start, reference = centre(incompressible) - start;
  record("rise, mm", 1e3 * rise);
  record("rise of the incompressible, mm", 1e3 * reference);
  record("fluid mass", fluid_error(gas));
  EXPECT_GT(reference, 1e-3);
  EXPECT_NEAR(rise, reference, 0.05 * reference);
  EXPECT_NEAR(measures::species_volumes(gas.constants().grid, gas.fields().solids)[0], volume, 1e-12 * volume);
  EXPECT_LT(fluid_error(gas), 1e-3);  // the invariant's limit, rtol
}

/// Solids that are fed through a part of the bottom and a part of the top, and leave beside that through an open top.
core::Scene crossed_ends(const char* law, const char* integrator) {
  const bool gas = law == std::string("ideal_gas");
  core::Scene scene = gas ? uniform_bed(60e-6, 1500, 1.204118, 1.813e-5, 0.3, 16, 0.08)
                          : uniform_bed(0.2e-3, 2200, 1000, 1e-3, 0.3, 16, 0.08);
  scene.column.size[0] = 0.02;
  scene.column.cells[0] = 4;
  scene.column.sides = core::Boundary::wall;
  scene.column.outlet = core::Outlet::open;
  scene.fluid.equation_of_state = core::choice_of<core::Compressibility>(law);
  scene.fluid.tait_stiffness = 1e6;  // Pa: sound of 85 m/s, so that explicit steps are few
  scene.bed.static_height = 0.06;
  scene.tfm.max_packing = 0.64;
  const double velocity = gas ? 1.5 : 0.1;
  scene.inlet.superficial_velocity = {{0.0, velocity}};
  scene.feeds.push_back({"solid", core::ColumnFace::bottom, {{0.0, 0.02 * velocity}}, velocity, {0.0}, {0.01}});
  scene.feeds.push_back({"solid", core::ColumnFace::top, {{0.0, 0.01 * velocity}}, velocity, {0.015}, {0.02}});
  scene.effects = {{"drag", "gidaspow"}, {"solids_stress", "frictional"}};
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
  return scene;
}

using LawAndIntegrator = std::tuple<const char*, const char*>;
class CrossedEnds : public testing::TestWithParam<LawAndIntegrator> {};

// The account of the fluid counts what the fluid takes through the ends, not what it takes together with the solids:
// that missed by 0.08 to 0.16 of the mass here.
TEST_P(CrossedEnds, TheAccountOfTheFluidCloses) {
  const auto& [law, integrator] = GetParam();
  const core::Scene scene = crossed_ends(law, integrator);
  core::Timers timers;
  tfm::Model model(scene, timers);
  advance(model, law == std::string("ideal_gas") ? 0.06 : 0.4);
  const fluid::Passed solids = model.passed()[0];
  const core::Grid& grid = model.constants().grid;
  const double column = grid.cell_volume() * double(grid.cell_count());
  record("fluid mass", fluid_error(model));
  record("solids out over the column", solids.out / column);
  EXPECT_GT(solids.out, 0.02 * column);
  EXPECT_GT(solids.in, 0.005 * column);
  EXPECT_LT(fluid_error(model), scene.tfm.rtol);  // the invariant's limit
}

INSTANTIATE_TEST_SUITE_P(Laws, CrossedEnds,
                         testing::Combine(testing::Values("tait", "ideal_gas"),
                                          testing::Values("explicit", "implicit")));

class CompressibleRestart : public testing::TestWithParam<const char*> {};

TEST_P(CompressibleRestart, ResumedRunGivesTheSameBits) {
  core::Scene scene = gas_bed("ideal_gas");
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(GetParam());
  scene.inlet.superficial_velocity = {{0.0, 0.4}, {0.001, 0.4}, {0.001, 0.5}};  // a jump at the checkpoint
  const TwoEnds ends = through_and_resumed(scene, 0.001, 0.002);
  EXPECT_EQ(ends.through.arrays, ends.resumed.arrays);
  EXPECT_EQ(ends.through.numbers, ends.resumed.numbers);  // the account of the fluid among them
  EXPECT_EQ(ends.through.integers, ends.resumed.integers);
}

// The pressure that implicit steps carry is what a compressible fluid needs to begin with.
TEST(CompressibleBed, BeginsWhereAnIncompressibleFluidStands) {
  core::Timers timers;
  tfm::Model before(gas_bed("incompressible"), timers), after(gas_bed("ideal_gas"), timers);
  while (before.time() < 0.01) before.step(0.01);
  before.restart();
  before.show(before.time());
  after.start_from(before.checkpoint());
  after.show(0);
  EXPECT_EQ(after.fields().solids.fraction[0], before.fields().solids.fraction[0]);
  EXPECT_EQ(after.fields().fluid.pressure, before.fields().fluid.pressure);
  const double mass = fluid::fluid_mass(after.constants().grid, after.fields().fluid);
  EXPECT_EQ(after.fluid_account(0)->start, mass);
  EXPECT_EQ(after.fluid_account(0)->in, 0);
  advance(after, 0.002);
  EXPECT_LT(fluid_error(after), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Integrators, CompressibleRestart, testing::Values("explicit", "implicit"));

}  // namespace
}  // namespace polybed::scenes
