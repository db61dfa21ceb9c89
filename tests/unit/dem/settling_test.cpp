// How long a bed is expected to take until it rests, against one that settles.
#include "dem/settling.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/timers.hpp"
#include "dem/measures.hpp"
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

core::Scene without_friction() {
  core::Scene scene = settling("none");
  scene.effects["contact"] = "hertz";
  scene.bed.particles = {250};
  return scene;
}

core::Scene lighter_than_the_liquid() {
  core::Scene scene = settling("liquid");
  scene.species[0].density = 400;
  scene.bed.particles = {60};
  return scene;
}

// Within a factor of 2, as the forecast of the time of a run has it; in a fluid although it will flow later, without
// friction, where a bed creeps on, and for a bed that rises through all of the column, 15 times its own height.
TEST(Settling, TakesAboutTheTimeExpected) {
  for (const core::Scene& scene :
       {settling("none"), settling("liquid"), without_friction(), lighter_than_the_liquid()}) {
    core::Timers timers;
    const Model model(scene, timers);
    const double time = settled(scene, model.limits().dt, nullptr).numbers.at("time");
    const double expected = settling_time(scene, model.materials(), model.box());
    EXPECT_LT(time, 2 * expected) << scene.fluid.name << " " << scene.effects.at("contact");
    EXPECT_GT(time, expected / 2) << scene.fluid.name << " " << scene.effects.at("contact");
  }
}

// 6 spheres of 10 mm in 75 Pa s settle alone at d^2 1500 g/(18 mu) = 1.09 mm/s, with a hundred-thousandth of the energy
// that lifts them by their radius: all the way down it is little, and they rest only once they no longer sink.
TEST(Settling, IsNoRestInAViscousLiquid) {
  core::Scene scene = settling("liquid");
  scene.species[0].diameter = 10e-3;
  scene.column.size = {30e-3, 60e-3, 22e-3};
  scene.column.cells = {3, 6, 1};
  scene.bed.particles = {6};
  scene.bed.start_solids_fraction = 0.15;
  scene.dem.youngs_modulus = 5e4;
  scene.fluid.viscosity = 75;
  scene.inlet.superficial_velocity = {{0, 1e-4}};
  core::Timers timers;
  Model model(scene, timers);
  const core::Checkpoint rest = settled(scene, model.limits().dt, nullptr);
  model.start_from(rest);
  const double alone = 1e-4 * 1500 * 9.81 / (18 * 75);
  double lowest = 1, square = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const Motion& m = model.particles().motion[i];
    lowest = std::min(lowest, model.particles().place[i].x[1]);
    square += (m.v[0] * m.v[0] + m.v[1] * m.v[1] + m.v[2] * m.v[2]) / 6;
  }
  EXPECT_LT(lowest, 5e-3) << "on the bottom";
  EXPECT_LT(std::sqrt(square), 1e-3 * alone);
  EXPECT_GT(rest.numbers.at("time"), 0.5 * 10e-3 / alone) << "nobody falls a diameter in less";
}

// A constant rolling moment keeps a bed creeping, since its sign follows that of the spin. The bed rests all the same,
// and the run begins from it with its own law: the same contacts, no energy of rolling springs.
TEST(Settling, EndsUnderAConstantRollingMoment) {
  core::Scene scene = settling("none");
  scene.effects["rolling"] = "cdt";
  scene.dem.rolling_friction = 0.2;
  core::set_friction(scene, 0.2);
  core::Timers timers;
  Model model(scene, timers);
  const core::Checkpoint rest = settled(scene, model.limits().dt, nullptr);
  EXPECT_LT(rest.numbers.at("time"), 2 * settling_time(scene, model.materials(), model.box()));
  model.start_from(rest);
  const Totals start = totals_of(model);
  EXPECT_GT(start.contacts, 500);
  EXPECT_EQ(start.dissipated, 0);
  while (model.time() < 0.01) model.step(1e300);
  const Totals now = totals_of(model);
  EXPECT_NEAR(now.sum(), start.sum(), 1e-3 * (now.kinetic + now.rotational + now.elastic + now.dissipated));
}

// Spheres without friction slide through joined sides for ever: the end says so, and has been seen coming.
TEST(Settling, SaysWhatDoesNotRest) {
  core::Scene scene = settling("none");
  scene.effects["contact"] = "hertz";
  scene.column.sides = core::Boundary::periodic;
  scene.bed.particles = {5};
  scene.bed.start_solids_fraction = 0.02;
  scene.dem.start_speed = 0.2;
  core::Timers timers;
  const Model model(scene, timers);
  double last = 0;
  int looks = 0;
  const auto see = [&](const Settling& bed) {
    EXPECT_GT(bed.time, last);
    EXPECT_GT(bed.over_rest, 1);
    last = bed.time;
    ++looks;
  };
  try {
    (void)settled(scene, model.limits().dt, nullptr, see);
    ADD_FAILURE() << "at rest";
  } catch (const core::NumericsError& error) {
    EXPECT_THAT(error.what(), testing::ContainsRegex("has not come to rest in .* the fastest particle moves at"));
  }
  EXPECT_GT(looks, 5);
}

}  // namespace
}  // namespace polybed::dem::test
