// Stress of two spheres by hand.
#include "scenes/dem_gas.hpp"

namespace polybed::scenes {
namespace {

/// A periodic cube of 10 mm with two spheres of 1 mm, 2500 kg/m3 (1.3089969390e-6 kg), springs of 1000 N/m.
core::Scene cube() {
  core::Scene scene = dry_box(0.5e-3, {1e6, 0.25, 2500}, {0.01, 0.01, 0.01});
  scene.column.sides = scene.column.ends = core::Boundary::periodic;
  scene.effects["contact"] = "linear";
  scene.dem.normal_stiffness = 1000;
  core::set_restitution(scene, 1);
  core::set_friction(scene, 0);
  scene.dem.tail = core::Tail::keep;
  return scene;
}

constexpr double digits = 1e-9;  // those the numbers by hand are given to

// n = (3, 4, 0)/5, r = 0.99 mm: F = 0.01 N, r F/V = 9.9 Pa, times 0.36, 0.48, 0.64. m v v/V by hand.
TEST(DemStress, TwoSpheresByHand) {
  Beads beads(cube(), {{"a", {5.594e-3, 5.792e-3, 5e-3}, {0.1, 0.2, 0}}, {"a", {5e-3, 5e-3, 5e-3}, {0, 0, -0.3}}});
  const dem::Stress s = dem::stress_of(beads.model);
  EXPECT_EQ(s.contacts, 1);
  compare("contact xx", s.contact[0][0], 3.564, digits);
  compare("contact xy", s.contact[0][1], 4.752, digits);
  compare("contact yx", s.contact[1][0], 4.752, digits);
  compare("contact yy", s.contact[1][1], 6.336, digits);
  compare("contact zz", s.contact[2][2], 0, digits, 1);
  compare("kinetic xx", s.kinetic[0][0], 0.013089969390, digits);
  compare("kinetic xy", s.kinetic[0][1], 0.026179938780, digits);
  compare("kinetic yy", s.kinetic[1][1], 0.052359877560, digits);
  compare("kinetic zz", s.kinetic[2][2], 0.117809724510, digits);
  compare("pressure", s.pressure(), (9.9 + 0.183259571460) / 3, digits);
  compare("temperature", s.temperature[0], 0.14 / 6, digits);
}

// Across the joined faces of a sheared box, gamma = 10 1/s: the upper sphere is seen one box down and 0.1 m/s slower,
// both move with the flow. n = (3, 4, 0)/5 from the image to the lower sphere, v_n = gamma r_y n_x = 4.752e-3 m/s.
// e = 0.9: beta = 0.0335184, c = 2 beta sqrt(k m*), F = 0.01 - c v_n.
TEST(DemStress, ShearedBox) {
  core::Scene scene = cube();
  core::set_restitution(scene, 0.9);
  scene.column.shear_rate = 10;
  const double low = 0.4e-3, high = 0.01 + low - 0.792e-3;
  Beads beads(scene, {{"a", {5.594e-3, low, 5e-3}, {10 * low, 0, 0}}, {"a", {5e-3, high, 5e-3}, {10 * high, 0, 0}}});
  const dem::Stress s = dem::stress_of(beads.model);
  const double beta = -std::log(0.9) / std::hypot(pi, std::log(0.9));
  const double force = 0.01 - 2 * beta * std::sqrt(1000 * 0.5 * 1.3089969390e-6) * 4.752e-3;
  EXPECT_EQ(s.contacts, 1);
  compare("contact xy", s.contact[0][1], 475.2 * force, digits);
  compare("contact yy", s.contact[1][1], 633.6 * force, digits);
  compare("viscosity", s.viscosity(), -47.52 * force, digits);
  for (const auto& row : s.kinetic)
    for (const double component : row) EXPECT_NEAR(component, 0, 1e-15);  // round-off of gamma y
}

// Spheres that turn the same way rub: n = (0, 1, 0) from the lower to the upper, F_n = 0.01 N, the lower one's top goes
// against x. After one step friction is at its limit, 0.005 x 0.01 N on the upper one against x, r = 0.99 mm:
// x-momentum passes on along y, r F_x/V = -0.0495 Pa, and none the other way round: of a torque only sigma_yx is the
// work of a shear. 3 %: in the step the normal force falls by 1 to 2 %.
TEST(DemStress, OfATorqueOnlyTheForceAlongTheFlowWorks) {
  core::Scene scene = cube();
  core::set_friction(scene, 0.005);
  scene.column.shear_rate = 10;
  Beads beads(scene, {{"a", {5e-3, 4e-3, 5e-3}, {}, {0, 0, 100}}, {"a", {5e-3, 4.99e-3, 5e-3}, {}, {0, 0, 100}}});
  beads.model.step(1e300);
  const dem::Stress s = dem::stress_of(beads.model);
  compare("contact yx", s.contact[1][0], -0.0495, 0.03);
  EXPECT_LT(std::abs(s.contact[0][1]), 1e-3 * 0.0495);
  EXPECT_EQ(s.shear(), -s.component(1, 0));
}

// A sheared box begins with the flow, x-velocity gamma y and the spin of its vorticity, -gamma/2 about z.
TEST(DemStress, ASphereBeginsWithTheSpinOfTheFlow) {
  const core::Scene scene = scene_of({.number = 100, .fraction = 0.2, .restitution = 0.9, .shear_rate = 50});
  GasRun run({.shear_rate = 50}, scene);
  for (std::size_t i = 0; i < run.model.particles().owned; ++i)
    EXPECT_EQ(run.model.particles().motion[i].w, (dem::Vector{0, 0, -25}));
}

// Looking at the stress changes nothing.
TEST(DemStress, NothingMovesOn) {
  core::Scene scene = scene_of({.number = 100, .fraction = 0.4, .restitution = 0.9, .shear_rate = 50});
  core::set_friction(scene, 0.5);
  GasRun looked({.shear_rate = 50}, scene), left({.shear_rate = 50}, scene);
  for (int n = 0; n < 300; ++n) {
    looked.model.step(1e300);
    left.model.step(1e300);
    EXPECT_GE(dem::stress_of(looked.model).contacts, 0);
  }
  EXPECT_EQ(looked.model.checkpoint().arrays, left.model.checkpoint().arrays);
}

}  // namespace
}  // namespace polybed::scenes
