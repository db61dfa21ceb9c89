// A gas bed with all that the solids' stress can have: both integrators run it and agree; what must not change it does
// not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "scenes/record.hpp"
#include "tfm/observers.hpp"

namespace polybed::scenes {
namespace {

/// Glass of two sizes, fluidised by air above the minimum of both, on a coarse grid.
core::Scene gas_bed(const std::string& temperature) {
  core::Scene scene = binary_bed(6, 40, 0.03, 0.2);
  scene.fluid.name = "test gas";
  scene.fluid.temperature.reset();
  scene.fluid.density = 1.2;
  scene.fluid.viscosity = 1.8e-5;
  scene.species[0].diameter = 0.4e-3;
  scene.species[1].diameter = 0.6e-3;
  scene.species[0].density = scene.species[1].density = 2500;
  scene.inlet.superficial_velocity = {{0.0, 0.6}};
  scene.effects = {{"drag", "gidaspow"},
                   {"solids_stress", "kinetic"},
                   {"granular_temperature", temperature},
                   {"solids_viscosity", "schaeffer"},
                   {"species_exchange", "syamlal"}};
  scene.tfm.solids_wall = core::SolidsWall::johnson_jackson;
  scene.tfm.rtol = 1e-4;
  return scene;
}

class GasBed : public testing::TestWithParam<std::string> {};

TEST_P(GasBed, IsTheSameByBothIntegrators) {
  core::Scene scene = gas_bed(GetParam());
  core::Timers timers;
  tfm::Model by_steps(scene, timers);
  scene.tfm.integrator = core::TfmIntegrator::implicit_steps;
  tfm::Model by_newton(scene, timers);
  const std::vector<double> mass = tfm::masses(by_steps);
  for (tfm::Model* model : {&by_steps, &by_newton}) {
    advance(*model, 0.05);
    for (std::size_t j = 0; j < mass.size(); ++j)
      EXPECT_NEAR(tfm::masses(*model)[j], mass[j], 1e-12 * mass[j]);  // round-off of sums over the steps
    for (const core::Field& theta : model->fields().solids.temperature) {
      EXPECT_GT(*std::max_element(theta.begin(), theta.end()), 1e-5);  // grains at 1 cm/s, driven by slip of 60 cm/s
      EXPECT_GT(*std::min_element(theta.begin(), theta.end()), -1e-4 * 0.36);  // rtol U^2
    }
  }
  // Each keeps its error near 1e-4 per step; ten times that.
  const double apart =
      distance(by_steps.constants().grid, by_steps.fields().solids.fraction[0], by_newton.fields().solids.fraction[0]);
  record("distance", apart);
  record("steps, explicit", double(by_steps.work().steps));
  record("steps, implicit", double(by_newton.work().steps));
  EXPECT_LT(apart, 1e-3);
}

TEST_P(GasBed, ASpeciesCutInTwoMovesAsOne) {
  core::Scene whole = gas_bed(GetParam());
  whole.effects.erase("species_exchange");
  whole.tfm.fixed_step = 2e-5;
  whole.tfm.pressure_tolerance = 1e-13;
  core::Scene cut = whole;
  cut.species.push_back(cut.species[1]);
  cut.species[2].name = "coarse too";
  cut.bed.volume_share = {0.569, 0.2, 0.231};
  core::Timers timers;
  tfm::Model a(whole, timers), b(cut, timers);
  advance(a, 1e-3);
  advance(b, 1e-3);
  core::Field sum = b.fields().solids.fraction[1];
  for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += b.fields().solids.fraction[2][c];
  const core::Grid& grid = a.constants().grid;
  record("distance", distance(grid, a.fields().solids.fraction[1], sum));
  EXPECT_LT(distance(grid, a.fields().solids.fraction[1], sum), 1e-10);  // as in the test of a liquid bed
  const auto &theta = a.fields().solids.temperature, &theta_cut = b.fields().solids.temperature;
  for (std::size_t j : {std::size_t(1), std::size_t(2)}) EXPECT_LT(distance(grid, theta[1], theta_cut[j]), 1e-10);
}

TEST_P(GasBed, ResumedRunGivesTheSameBits) {
  for (const char* integrator : {"explicit", "implicit"}) {
    core::Scene scene = gas_bed(GetParam());
    scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
    scene.tfm.rtol = 1e-3;
    const TwoEnds ends = through_and_resumed(scene, 5e-3, 0.01);
    EXPECT_EQ(ends.through.arrays.at("state"), ends.resumed.arrays.at("state")) << integrator;
  }
}

/// The bed in a box, looser along a horizontal axis from one wall to the other; steps of one length.
core::Scene box_of_gas(const std::string& temperature, int nx, int nz, const std::string& sides) {
  core::Scene scene = gas_bed(temperature);
  scene.column.dimensions = nz > 1 ? 3 : 2;
  scene.column.cells = {nx, 16, nz};
  scene.column.size = {5e-3 * nx, 0.08, 5e-3 * nz};
  scene.bed.static_height = 0.03;
  scene.column.sides = core::choice_of<core::Boundary>(sides);
  scene.tfm.fixed_step = 5e-5;
  scene.tfm.pressure_tolerance = 1e-13;
  scene.tfm.bulk_viscosity = 1;  // its default knows the number of directions
  return scene;
}

// Round-off of 100 steps, and the pressure solver's tolerance of 1e-13; velocities and temperatures are below 1.
TEST_P(GasBed, TreatsNoDirectionInItsOwnWay) {
  const auto looser = [](int n, int j) { return 1 - 0.1 * std::exp(-0.5 * std::pow(n, 2) - 0.1 * std::pow(j - 2, 2)); };
  const auto along_x = [&](int i, int j, int) { return looser(i, j); };
  const auto along_z = [&](int, int j, int k) { return looser(k, j); };
  core::Timers timers;
  tfm::Model wide(box_of_gas(GetParam(), 5, 3, "wall"), timers), deep(box_of_gas(GetParam(), 3, 5, "wall"), timers);
  tfm::Model even(box_of_gas(GetParam(), 5, 3, "periodic"), timers),
      flat(box_of_gas(GetParam(), 5, 1, "periodic"), timers);
  make_uneven(wide, along_x);
  make_uneven(deep, along_z);
  make_uneven(even, along_x);
  make_uneven(flat, along_x);
  for (tfm::Model* model : {&wide, &deep, &even, &flat}) advance(*model, 5e-3);
  const auto value = [](const tfm::Model& model, int axis, int i, int j, int k) {
    const auto at = std::size_t(model.constants().grid.index(i, j, k));
    const fluid::Interphase& solids = model.fields().solids;
    return axis < 0 ? solids.temperature[0][at] : solids.velocity[0][std::size_t(axis)][at];
  };
  double turned = 0, in_depth = 0, most = 0;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 5; ++i)
        for (int axis : {-1, 0, 1}) {
          most = std::max(most, std::abs(value(wide, 0, i, j, k)));
          turned = std::max(turned, std::abs(value(wide, axis, i, j, k) - value(deep, axis == 0 ? 2 : axis, k, j, i)));
          in_depth = std::max(in_depth, std::abs(value(even, axis, i, j, k) - value(flat, axis, i, j, 0)));
        }
  record("greatest difference, turned", turned);
  record("greatest difference, in depth", in_depth);
  EXPECT_LT(turned, 1e-12);
  EXPECT_LT(in_depth, 1e-12);
  EXPECT_GT(most, 1e-3) << "the bed must move sideways, or the test says nothing";
}

INSTANTIATE_TEST_SUITE_P(Temperatures, GasBed, testing::Values(std::string("algebraic"), std::string("transported")));

// What is absent has no state and no fields.
TEST(GasBed, WithoutKineticStressHasNoTemperature) {
  core::Scene scene = gas_bed("transported");
  core::Timers timers;
  const tfm::Model with(scene, timers);
  scene.effects["solids_stress"] = "frictional";
  scene.effects.erase("granular_temperature");
  const tfm::Model without(scene, timers);
  EXPECT_EQ(with.unknowns(), without.unknowns() + 2 * 6 * 40);
  EXPECT_TRUE(without.fields().solids.temperature.empty());
  EXPECT_TRUE(without.fields().stress.wall.empty());
  scene.effects.erase("solids_viscosity");
  scene.tfm.solids_wall = core::SolidsWall::free_slip;
  const tfm::Model bare(scene, timers);
  EXPECT_FALSE(bare.fields().stress.viscous());
  EXPECT_TRUE(bare.fields().stress.strain.empty());
  EXPECT_TRUE(bare.fields().stress.contact.empty());
}

TEST(GasBed, RefusesWhatCannotAct) {
  core::Timers timers;
  const auto refused = [&](auto&& change) {
    core::Scene scene = gas_bed("algebraic");
    change(scene);
    EXPECT_THROW(tfm::Model(scene, timers), core::CaseError);
  };
  refused([](core::Scene& s) { s.effects["solids_stress"] = "frictional"; });  // a temperature without collisions
  refused([](core::Scene& s) { s.species[0].restitution = 1; });               // nothing limits the temperature
  refused([](core::Scene& s) {
    s.effects = {{"drag", "gidaspow"}, {"solids_stress", "frictional"}};  // partial slip without viscosity
  });
  refused([](core::Scene& s) {
    s.effects = {{"drag", "gidaspow"}, {"solids_viscosity", "mu_i"}};  // a viscosity of no pressure
    s.tfm.solids_wall = core::SolidsWall::free_slip;
  });
}

}  // namespace
}  // namespace polybed::scenes
