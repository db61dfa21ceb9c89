// Minimum fluidisation: the velocity at which the pressure drop of a packed bed reaches its weight.
#include <gtest/gtest.h>

#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

/// 60 mm of 1 mm, 2500 kg/m3, in air of 1.2 kg/m3, 1.8e-5 Pa s, packed at 0.60 by a pressure so stiff that the fraction
/// differs by less than 0.001 from bottom to top.
core::Scene gas_bed(double superficial_velocity) {
  core::Scene scene = uniform_bed(1e-3, 2500, 1.2, 1.8e-5, 0.6, 60, 0.12);
  scene.effects = {{"drag", "ergun"}, {"solids_stress", "frictional"}};
  scene.bed.static_height = 0.06;
  scene.bed.start = {core::StartKind::settled};
  scene.tfm.frictional_onset = 0.5995;
  scene.tfm.max_packing = 0.606;
  scene.inlet.superficial_velocity = {{0.0, 0.0}, {0.05, superficial_velocity}};
  scene.tfm.integrator = core::TfmIntegrator::implicit_steps;
  return scene;
}

constexpr double excess_weight = (2500 - 1.2) * 9.81;  // of the solids less buoyancy, N per m3 of them

/// Net pressure gradient over the weight of the solids it acts on, in the middle half of the bed: the drop over the
/// whole bed would miss half a cell at its surface.
double weight_carried(const tfm::Model& model) {
  const core::Grid& grid = model.constants().grid;
  const auto at = [&](int j) { return std::size_t(grid.index(0, j)); };
  const core::Field &p = model.fields().fluid.pressure, &phi = model.fields().solids_fraction;
  double solids = 0.5 * (phi[at(7)] + phi[at(22)]);
  for (int j = 8; j < 22; ++j) solids += phi[at(j)];
  return (p[at(7)] - p[at(22)]) / (solids * grid.spacing[1] * excess_weight);
}

double weight_carried_at(double superficial_velocity) {
  core::Timers timers;
  tfm::Model model(gas_bed(superficial_velocity), timers);
  advance(model, 0.1);
  return weight_carried(model);
}

/// Where a U + b U^2, Ergun's form, through two points becomes 1.
double crossing(double u_1, double carried_1, double u_2, double carried_2) {
  const double b = (carried_2 / u_2 - carried_1 / u_1) / (u_2 - u_1), a = carried_1 / u_1 - b * u_1;
  return (std::sqrt(a * a + 4 * b) - a) / (2 * b);
}

// Ergun at eps 0.40: the branches cross at 0.5608 m/s. 1 %: the bed is up to 0.0005 looser than 0.60, which is 0.4 % of
// the gradient. The middle point must lie on the curve through the other two.
TEST(MinimumFluidisation, TheBranchOfThePackedBedMeetsTheWeight) {
  const double low = weight_carried_at(0.3), middle = weight_carried_at(0.4), high = weight_carried_at(0.5);
  const double found = crossing(0.3, low, 0.5, high);
  record("crossing, m/s", found);
  EXPECT_NEAR(found, 0.5608, 0.01 * 0.5608);
  EXPECT_NEAR(crossing(0.3, low, 0.4, middle), found, 1e-3 * found);
}

/// Least and greatest solids pressure on the distributor, Pa, from 0.07 to 0.1 s.
std::pair<double, double> pressure_at_bottom(double superficial_velocity) {
  core::Timers timers;
  tfm::Model model(gas_bed(superficial_velocity), timers);
  double least = 1e9, most = 0;
  for (const double t : {0.07, 0.08, 0.09, 0.1}) {
    advance(model, t);
    const double pressure = model.fields().stress.pressure[std::size_t(model.constants().grid.index(0, 0))];
    least = std::min(least, pressure);
    most = std::max(most, pressure);
  }
  return {least, most};
}

// The bed rests on its bottom 3 % below the crossing and has left it 3 % above. Nearer than that, what is left of the
// start's elastic waves lets it touch and leave the bottom by turns.
TEST(MinimumFluidisation, TheSolidsPressureYieldsThere) {
  const auto below = pressure_at_bottom(0.97 * 0.5608), above = pressure_at_bottom(1.03 * 0.5608);
  record("least solids pressure 3 % below", below.first);
  record("greatest solids pressure 3 % above", above.second);
  EXPECT_GT(below.first, 0.0);
  EXPECT_EQ(above.second, 0.0);
}

}  // namespace
}  // namespace polybed::scenes
