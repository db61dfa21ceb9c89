// At rest: no pressure in a fluid alone, and a settled bed that carries its weight and stays where it is.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/numerics/operators.hpp"
#include "core/output/checkpoint.hpp"
#include "scenes/record.hpp"
#include "scenes/settled_glass.hpp"
#include "tfm/state_layout.hpp"

namespace polybed::scenes {
namespace {

/// The greatest flux J on any face, and of each species the greatest |U_j| on faces with more than 1e-9 of
/// solids: where there are none, U_j is that of a particle alone, which falls.
double greatest_velocity(const tfm::Model& model) {
  double most = 0;
  const core::Grid& grid = model.constants().grid;
  const tfm::Fields& fields = model.fields();
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    core::for_each_row(grid, core::interior_faces(grid, axis), [&](core::Index begin, core::Index end) {
      for (core::Index f = begin; f < end; ++f) {
        most = std::max(most, std::abs(fields.fluid.flux[a][std::size_t(f)]));
        for (std::size_t j = 0; j < fields.solids.species(); ++j)
          if (core::face_mean(fields.solids.fraction[j].data(), f, grid.stride(axis)) > 1e-9)
            most = std::max(most, std::abs(fields.solids.velocity[j][a][std::size_t(f)]));
      }
    });
  }
  return most;
}

/// 1.2 mm, 2700 kg/m3 in water at 20 degC, closed column of 0.2 m.
core::Scene column(int cells) {
  core::Scene scene = uniform_bed(1.2e-3, 2700, 998.207, 1.00157e-3, 0.6, cells, 0.2);
  scene.column.closed = true;
  scene.effects["solids_stress"] = "frictional";
  scene.bed.start = {core::StartKind::settled};
  return scene;
}

TEST(Hydrostatics, AFluidAtRestHasNoNetPressureToTheBit) {
  core::Scene scene = binary_bed(6, 20, 0.03, 0.1);
  scene.column.closed = true;
  scene.inlet.superficial_velocity = {{0.0, 0.0}};
  scene.bed.static_height = 0;
  scene.tfm.max_packing = 0.64;
  core::Timers timers;
  tfm::Model model(scene, timers);
  advance(model, 0.5);
  EXPECT_EQ(greatest_velocity(model), 0.0);
  for (const double p : model.fields().fluid.pressure) EXPECT_EQ(p, 0.0);
}

// 90 mm of solids volume per area: buoyant weight 0.09 (2700 - 998.207) 9.81 = 1502.469 Pa, by hand. The mass
// is chosen near it so that the top layer, too, is in equilibrium: p_s of a cell with none above carries half
// of it. Steps of one length, half of what the elastic waves allow: error control lets a stiff balance
// tremble at a tenth of its tolerance.
TEST(Hydrostatics, ASettledBedCarriesItsWeightAndStays) {
  constexpr int cells = 20;
  core::Scene scene = column(cells);
  scene.tfm.fixed_step = 5e-4;
  const double dy = 0.2 / cells, weight = (2700 - 998.207) * 9.81 * dy;
  core::Timers timers;
  {
    scene.bed.static_height = 0.15;  // 90 mm of solids: a model to take the stress from
    const tfm::Model model(scene, timers);
    scene.tfm.max_packing = model.effects().solids_stress->max_packing();
    const auto pressure = [&](double phi) { return model.effects().solids_stress->pressure_at(phi); };
    const auto settle = [&](double above_phi, double above_pressure) {
      double low = 0.5, high = 0.7;
      for (int n = 0; n < 200; ++n) {
        const double phi = 0.5 * (low + high);
        (pressure(phi) < above_pressure + 0.5 * (phi + above_phi) * weight ? low : high) = phi;
      }
      return 0.5 * (low + high);
    };
    double phi = 0, sum = 0;
    while (sum + phi < 0.09 / dy) {
      phi = settle(phi, phi > 0 ? pressure(phi) : 0.0);
      sum += phi;
    }
    scene.bed.static_height = sum * dy / scene.bed.solids_fraction;
  }
  tfm::Model model(scene, timers);
  model.show(0);
  const auto bottom = std::size_t(model.constants().grid.index(0, 0));
  const tfm::Fields& fields = model.fields();
  const double solids = scene.bed.static_height * scene.bed.solids_fraction;
  const double carried = fields.stress.pressure[bottom] + 0.5 * fields.solids_fraction[bottom] * weight;
  EXPECT_NEAR(carried, solids / dy * weight, 1e-10 * carried);
  EXPECT_NEAR(carried, 1502.469, weight);  // within the cell by which the mass differs from 90 mm
  advance(model, 3.0);
  // Round-off of a balance of 1500 Pa over cells of 10 mm, held by drag: some 1e-16 m/s. 1e-10 is this project's goal
  // for a bed at rest.
  record("relative error of the weight", carried / (solids / dy * weight) - 1);
  record("greatest velocity", greatest_velocity(model));
  EXPECT_LT(greatest_velocity(model), 1e-10);
}

class BedAtRest : public testing::TestWithParam<const char*> {};

/// 0.1 m of glass of 0.5 mm in water or air, cells of 3 mm, and a share of a further cell.
core::Scene filled_to(double share, bool gas, const char* integrator) {
  core::Scene scene = settled_glass(gas);
  scene.bed.static_height = 0.099 + 0.003 * share;
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
  return scene;
}

// However far the topmost cell is filled. 1e-10 m/s and 1e-6 of the weight are this project's goals; found 2e-11 and
// 2e-10. Implicit steps in a gas keep what their error test lets through, 4e-10 m/s a step and some steps of it: 3e-9
// found.
TEST_P(BedAtRest, RestsUpToItsSurface) {
  for (const bool gas : {false, true})
    for (const double share : {0.05, 0.3, 0.6, 0.95}) {
      SCOPED_TRACE(fmt::format("{}, share {}", gas ? "gas" : "liquid", share));
      const core::Scene scene = filled_to(share, gas, GetParam());
      core::Timers timers;
      tfm::Model model(scene, timers);
      advance(model, 0.5);
      const tfm::Fields& fields = model.fields();
      const auto bottom = std::size_t(model.constants().grid.index(0, 0));
      const double per_cell = (2500 - model.constants().fluid.density) * 9.81 * 0.003;
      const double carried = fields.stress.pressure[bottom] + 0.5 * fields.solids_fraction[bottom] * per_cell;
      const double weight = scene.bed.static_height * 0.58 / 0.003 * per_cell;
      const auto top = std::size_t(model.constants().grid.index(0, 39));
      const double drop = fields.fluid.pressure[bottom] - fields.fluid.pressure[top];
      record("greatest velocity", greatest_beside_solids(model));
      EXPECT_LT(greatest_beside_solids(model), gas && GetParam() == std::string("implicit") ? 1e-8 : 1e-10);
      EXPECT_NEAR(carried, weight, 1e-6 * weight);
      EXPECT_NEAR(drop, 0, 1e-6 * weight);
    }
}

// Dust in the row above the surface row lies on it, and its upper half, on the face above, nearly: of fractions below
// 1e-3, on which a pressure acts less, a part falls. 1.07 m/s found in gas, 3.2 m/s where nothing holds it.
TEST_P(BedAtRest, CarriesDustOnItsSurface) {
  const core::Scene scene = filled_to(0.3, true, GetParam());
  core::Timers timers;
  tfm::Model model(scene, timers);
  core::Checkpoint start = model.checkpoint();
  const tfm::StateLayout layout(model.constants().grid, 1, GetParam() == std::string("implicit"));
  for (const auto& entry : layout.entries())
    if (entry.kind == tfm::StateLayout::Entry::Kind::fraction) start.arrays.at("state")[entry.begin + 34] = 3e-4;
  model.start_from(start);
  advance(model, 0.5);
  const auto at = [&](int row) { return std::size_t(model.constants().grid.index(0, row)); };
  EXPECT_GT(model.fields().solids_fraction[at(34)], 1e-4);
  const double fall = -model.fields().solids.velocity[0][1][at(35)];
  record("velocity of dust", fall);
  EXPECT_LT(fall, 1.5);
}

// 1 mm glass in water at 40 mm/s, one column: however far the last cell is filled, the bed ends within two cells. 2 %
// is this project's goal, of the bed's fraction; 1.6 and 1.9 % found.
TEST(ExpandedBed, EndsWithinTwoCellsWithoutOvershoot) {
  for (const int cells : {50, 100}) {
    SCOPED_TRACE(cells);
    core::Scene scene = uniform_bed(1e-3, 2500, 998, 1e-3, 0.58, cells, 0.3);
    scene.effects["solids_stress"] = "frictional";
    scene.bed.start = {core::StartKind::settled};
    scene.bed.static_height = 0.1;
    scene.inlet.superficial_velocity = {{0.0, 0.04}};
    core::Timers timers;
    tfm::Model model(scene, timers);
    advance(model, 30);
    const auto phi = [&](int j) {
      return model.fields().solids_fraction[std::size_t(model.constants().grid.index(0, j))];
    };
    const double bed = phi(cells / 5);
    int between = 0;
    double most = 0;
    for (int j = 1; j < cells; ++j) {
      if (phi(j) > 0.02 * bed && phi(j) < 0.98 * bed) ++between;
      most = std::max(most, phi(j) / bed);
    }
    record("densest cell over the bed", most);
    EXPECT_LT(most, 1.02);
    EXPECT_LE(between, 2);
  }
}

// Any other mass leaves a loose layer on top, thinner than a cell; below it the bed is at rest within what
// the integrator's tolerance lets through.
TEST_P(BedAtRest, OfAnyMassRestsBelowItsTopLayer) {
  core::Scene scene = column(50);
  scene.bed.static_height = 0.15;
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(GetParam());
  core::Timers timers;
  tfm::Model model(scene, timers);
  model.show(0);
  const std::vector<double> before = model.fields().solids_fraction;
  advance(model, 1.0);
  EXPECT_LT(distance(model.constants().grid, before, model.fields().solids_fraction), 10 * scene.tfm.rtol);
}

INSTANTIATE_TEST_SUITE_P(Integrators, BedAtRest, testing::Values("explicit", "imex", "implicit"));

}  // namespace
}  // namespace polybed::scenes
