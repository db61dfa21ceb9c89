// A fixed bed: the pressure gradient that each drag law gives, and that buoyancy is counted once.
#include <gtest/gtest.h>

#include "closures/drag.hpp"
#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

/// -dp/dy in the middle of a bed of spheres too heavy to move (1e15 kg/m3), without gravity, after the fluid
/// has come to its steady flow.
double pressure_gradient(core::Scene scene, double superficial_velocity, double until) {
  scene.column.gravity = 0;
  scene.inlet.superficial_velocity = {{0.0, superficial_velocity}};
  scene.tfm.rtol = 1e-6;
  scene.tfm.pressure_tolerance = 1e-10;
  core::Timers timers;
  tfm::Model model(scene, timers);
  while (model.time() < until) model.step(until);
  const core::Grid& grid = model.constants().grid;
  const core::Field& p = model.fields().fluid.pressure;
  const int low = grid.cells[1] / 4, high = 3 * grid.cells[1] / 4;
  return (p[std::size_t(grid.index(0, low))] - p[std::size_t(grid.index(0, high))]) / (grid.spacing[1] * (high - low));
}

core::Scene immovable(const std::string& law, double solids_fraction) {
  core::Scene scene = uniform_bed(1e-3, 1e15, 1.2, 1.8e-5, solids_fraction, 8, 0.04);
  scene.effects["drag"] = law;
  return scene;
}

TEST(FixedBed, ErgunGivesTheTextbookGradient) {
  // 150 mu U (1-eps)^2/(eps^3 D^2) + 1.75 rho_f U^2 (1-eps)/(eps^3 D) at eps 0.40, U 0.30 m/s: 6328.125 Pa/m.
  // 1e-6: the Poisson tolerance 1e-10 and the steps' 1e-6 on a steady state.
  const double gradient = pressure_gradient(immovable("ergun", 0.60), 0.30, 0.02);
  record("relative difference", gradient / 6328.125 - 1);
  EXPECT_NEAR(gradient, 6328.125, 6328.125 * 1e-6);
}

class FixedBedLaw : public testing::TestWithParam<std::string> {};

TEST_P(FixedBedLaw, GradientIsDragOverVoidage) {
  // T(1.49): -dp/dy = sum_j 18 mu U phi_j f_j / (eps D_j^2), two sizes, f_j from the closure called by itself.
  core::Scene scene = immovable(GetParam(), 0.55);
  scene.species.push_back(scene.species[0]);
  scene.species[1].name = "large";
  scene.species[1].diameter = 1.6e-3;
  scene.bed.volume_share = {0.4, 0.6};
  const double superficial = 0.2, eps = 0.45;
  const std::vector<double> share = scene.bed.volume_share, diameter{1e-3, 1.6e-3};
  // Shares as the model's closures see them: phi_j + 1e-4 X_j over phi + 1e-4, which leaves x_j as they are.
  std::vector<double> f(2), derivative(2), slip(2, superficial);
  closures::drag_of_mixture(closures::drag_law(GetParam(), closures::Guard::on), eps, share, diameter, slip, 1.2,
                            1.8e-5, f, derivative);
  double expected = 0;
  for (std::size_t j = 0; j < 2; ++j)
    expected += 18 * 1.8e-5 * superficial * 0.55 * share[j] * f[j] / (eps * diameter[j] * diameter[j]);
  const double gradient = pressure_gradient(scene, superficial, 0.02);
  record("relative difference", gradient / expected - 1);
  EXPECT_NEAR(gradient, expected, 1e-6 * expected);
}

INSTANTIATE_TEST_SUITE_P(EveryLaw, FixedBedLaw, testing::ValuesIn(closures::drag_law_names()));

}  // namespace
}  // namespace polybed::scenes
