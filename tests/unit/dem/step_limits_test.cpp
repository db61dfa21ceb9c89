// Which integrator `dem.integrator = "auto"` chooses: forces of friction on small particles among large ones want spins
// and velocities at the time of the places.
#include "dem/step_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bench.hpp"

namespace polybed::dem::test {
namespace {

/// Two species without friction, the second `ratio` times as large.
core::Scene two_sizes(double ratio) {
  core::Scene scene = scene_of({});
  core::set_friction(scene, 0);
  scene.species.push_back(scene.species[0]);
  scene.species[1].name = "b";
  scene.species[1].diameter *= ratio;
  return scene;
}

StepLimits limits_of(const core::Scene& scene) {
  const Materials materials(scene);
  return step_limits(scene, materials, make_pair_laws(scene, materials), 1);
}

TEST(Integrator, IsThatOfTheThesisWithoutFriction) {
  const StepLimits limits = limits_of(two_sizes(3.5));
  EXPECT_FALSE(limits.synchronised);
  EXPECT_EQ(limits.integrator_reason, "no friction or a size ratio of 3.5, below 3");
}

TEST(Integrator, IsSynchronisedForTheFrictionOfOneSpecies) {
  core::Scene scene = two_sizes(3.5);
  scene.species[1].friction = 0.4;
  const StepLimits limits = limits_of(scene);
  EXPECT_TRUE(limits.synchronised);
  EXPECT_EQ(limits.integrator_reason, "friction and a size ratio of 3.5, at least 3");
}

TEST(Integrator, IsSynchronisedForTheFrictionOfOnePair) {
  for (const char* partner : {"b", "wall"}) {
    core::Scene scene = two_sizes(3.5);
    scene.contact_pairs.push_back({{"a", partner}, {}, {}, 0.4, {}});
    EXPECT_TRUE(limits_of(scene).synchronised) << partner;
  }
}

TEST(Integrator, IsThatOfTheThesisForSizesAlikeOrWithoutALawOfFriction) {
  core::Scene scene = two_sizes(2.9);
  scene.species[1].friction = 0.4;
  EXPECT_FALSE(limits_of(scene).synchronised);
  scene.species[1].diameter *= 3.1 / 2.9;
  EXPECT_TRUE(limits_of(scene).synchronised);
  scene.effects["contact"] = "hertz";
  EXPECT_FALSE(limits_of(scene).synchronised);
}

TEST(Integrator, IsTheOneThatTheCaseSays) {
  core::Scene scene = two_sizes(3.5);
  scene.dem.integrator = core::DemIntegrator::synchronised;
  EXPECT_TRUE(limits_of(scene).synchronised);
  scene.species[1].friction = 0.4;
  scene.dem.integrator = core::DemIntegrator::thesis;
  EXPECT_FALSE(limits_of(scene).synchronised);
}

// nu = 0.01 m2/s on cells of 1 mm: 2 nu dt (1/h^2 + 1/h^2) = 1/2 at 12.5 us.
TEST(Step, IsShortEnoughForTheViscosityOfAFluid) {
  core::Scene scene = scene_of({{"drag", "stokes"}, {"fluid_stress", "newtonian"}});
  scene.column.dimensions = 2;
  scene.column.size = {0.02, 0.03, 0.02};
  scene.column.cells = {20, 30, 1};
  scene.fluid.name = "honey";
  scene.fluid.density = 1000;
  scene.fluid.viscosity = 10;
  const StepLimits limits = limits_of(scene);
  EXPECT_EQ(limits.limited_by, "viscosity of the fluid");
  EXPECT_NEAR(limits.dt, 1.25e-5, 1e-15);
  scene.effects.erase("fluid_stress");
  EXPECT_GT(limits_of(scene).dt, limits.dt);
}

// Two undamped spheres of mass m on a linear spring k: omega = sqrt(2 k/m), and the limit 2/omega, by hand.
TEST(FixedStep, IsWarnedOfBeyondHalfTheLimitOfStability) {
  core::Scene scene = scene_of({});
  scene.effects["contact"] = "linear";
  scene.dem.normal_stiffness = 1000;
  core::set_restitution(scene, 1);
  const core::Species& s = scene.species[0];
  const double mass = s.density * 3.14159265358979 / 6 * s.diameter * s.diameter * s.diameter;
  const double limit = 2 / std::sqrt(2 * 1000 / mass);
  EXPECT_NEAR(limits_of(scene).stability.dt, limit, 1e-6 * limit);
  EXPECT_EQ(limits_of(scene).warning, "");
  scene.dem.fixed_step = 0.49 * limit;
  EXPECT_EQ(limits_of(scene).warning, "");
  scene.dem.fixed_step = 0.51 * limit;
  EXPECT_NE(limits_of(scene).warning.find("dem.fixed_step"), std::string::npos);
}

}  // namespace
}  // namespace polybed::dem::test
