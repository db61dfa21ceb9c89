// How long a bed is expected to take until it rests, against one that settles.
#include "dem/settling.hpp"

#include <gtest/gtest.h>

#include "core/timers.hpp"
#include "dem/model.hpp"
#include "dem/scene.hpp"

namespace polybed::dem::test {
namespace {

/// 500 spheres of 1 mm at a solids fraction of 0.3: 19.8 mm high in a strip of 20 x 2.2 mm.
core::Scene settling(const std::string& fluid) {
  core::Scene scene;
  core::Species sphere;
  sphere.name = "a";
  sphere.diameter = 1e-3;
  sphere.density = 2500;
  scene.species = {sphere};
  scene.column.size = {20e-3, 40e-3, 2.2e-3};
  scene.column.cells = {10, 20, 1};
  scene.bed.start = {core::StartKind::settled};
  scene.bed.particles = {500};
  scene.bed.solids_fraction = 0.6;
  scene.bed.start_solids_fraction = 0.3;
  scene.effects["contact"] = "hertz_mindlin";
  scene.dem.youngs_modulus = 5e5;  // soft: longer steps
  scene.fluid.name = fluid;
  if (fluid == "none") return scene;
  scene.fluid.density = 1000;
  scene.fluid.viscosity = 1e-3;
  scene.effects["drag"] = "gidaspow";
  scene.inlet.superficial_velocity = {{0, 0.2}};  // far above what fluidises them
  return scene;
}

// Within a factor of 2, as the forecast of the time of a run has it; in a fluid although it will flow later.
TEST(Settling, TakesAboutTheTimeExpected) {
  for (const std::string fluid : {"none", "liquid"}) {
    const core::Scene scene = settling(fluid);
    core::Timers timers;
    const Model model(scene, timers);
    const double time = settled(scene, model.limits().dt, nullptr).numbers.at("time");
    const double expected = settling_time(scene, model.materials(), model.box());
    EXPECT_LT(time, 2 * expected) << fluid;
    EXPECT_GT(time, expected / 2) << fluid;
  }
}

}  // namespace
}  // namespace polybed::dem::test
