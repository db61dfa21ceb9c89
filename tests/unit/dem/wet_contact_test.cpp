// Lubrication as a lower restitution: rebounds from a floor and of a pair against e exp(-35/St*).
#include <gtest/gtest.h>

#include <cmath>

#include "closures/lubrication.hpp"
#include "core/error.hpp"
#include "dem/effects/damping_table.hpp"
#include "dem/step_limits.hpp"
#include "pair_bench.hpp"

namespace polybed::dem::test {
namespace {

constexpr double fluid_density = 1000, viscosity = 1e-3;

core::Scene wet_scene(const std::string& contact, const std::string& tail) {
  core::Scene scene = scene_of({{"contact", contact}, {"lubrication", "wet_restitution"}});
  scene.fluid.name = "test liquid";
  scene.fluid.density = fluid_density;
  scene.fluid.viscosity = viscosity;
  core::set_restitution(scene, 0.9);
  scene.dem.tail = core::choice_of<core::Tail>(tail);
  scene.dem.normal_stiffness = 1e4;
  return scene;
}

constexpr double stokes_numbers[] = {20, 50, 100, 400, 2000};

TEST(WetContact, ReboundsFromAFloorWithTheRestitutionOfItsSpeed) {
  for (const char* contact : {"hertz_mindlin", "linear"})
    for (const char* tail : {"clip", "keep"})
      for (const double stokes : stokes_numbers) {
        const core::Scene scene = wet_scene(contact, tail);
        const double speed = stokes / closures::stokes_of_impact(2500, fluid_density, 5e-3, 1, viscosity);
        const double time = Bench(scene, 1).laws.normal->contact_time(1, speed);
        Bench bench(scene, time / 400);
        bench.add(-1e-9, {0, -speed, 0});
        do bench.step();
        while (bench.overlap(0) > 0 || bench.particles.motion[0].v[1] < 0);
        // 1 %: what 400 steps leave of a strongly damped impact, first order where the dashpot sets in.
        EXPECT_NEAR(bench.particles.motion[0].v[1] / speed, 0.9 * std::exp(-35 / stokes), 0.01 * 0.9)
            << contact << " " << tail << " " << stokes;
        EXPECT_EQ(*bench.memory(0), 0) << "the next contact begins anew";
      }
}

TEST(WetContact, ReboundsOfAPairLikewiseAndItsLedgerCloses) {
  for (const double stokes : stokes_numbers) {
    const core::Scene scene = wet_scene("hertz_mindlin", "clip");
    const Materials materials(scene);
    const PairMaterial& kind = materials.kinds()[0];
    const double speed = stokes / closures::stokes_of_pair(kind.mass, 1, viscosity, kind.radius);
    const double time = Bench(scene, 1).laws.normal->contact_time(0, speed);
    PairBench bench(scene, time / 400, 1e-9, speed);
    const double before = bench.kinetic();
    do bench.step();
    while (bench.gap() < 0 || bench.speed() > 0);
    EXPECT_NEAR(-bench.speed() / speed, 0.9 * std::exp(-35 / stokes), 0.01 * 0.9) << stokes;
    // Beyond the steps' round-off: the energy that a clipped tail leaves in the overlap is counted by its closed form,
    // at the end of a step; one step's work of the elastic force there.
    EXPECT_NEAR(bench.dissipated() / (before - bench.kinetic()), 1, 1e-3) << stokes;
  }
}

// With the steps that a run would take. What they leave is mostly that the first of them finds the contact somewhere
// within it.
TEST(WetContact, ReboundsWithinAHundredthOfTheApproachInStepsOfARun) {
  for (const double stokes : stokes_numbers) {
    const core::Scene scene = wet_scene("hertz_mindlin", "clip");
    const double speed = stokes / closures::stokes_of_impact(2500, fluid_density, 5e-3, 1, viscosity);
    const Materials materials(scene);
    const PairLaws laws = make_pair_laws(scene, materials);
    const StepLimits limits = step_limits(scene, materials, laws, speed);
    for (const double start : {0.1, 0.5, 0.9}) {
      Bench bench(scene, limits.dt);
      bench.add(-start * speed * limits.dt, {0, -speed, 0});
      do bench.step();
      while (bench.overlap(0) > 0 || bench.particles.motion[0].v[1] < 0);
      EXPECT_NEAR(bench.particles.motion[0].v[1] / speed, 0.9 * std::exp(-35 / stokes), 0.01);
    }
  }
}

TEST(WetContact, KeepsWhatTheFirstTouchDecided) {
  Bench bench(wet_scene("linear", "keep"), 1e-6);
  const double speed = 100 / closures::stokes_of_impact(2500, fluid_density, 5e-3, 1, viscosity);
  bench.add(1e-6, {0, -speed, 0});
  bench.press(1e-6, {0, -speed, 0});
  const double damping = *bench.memory(0), log = -std::log(0.9) + 0.35;
  EXPECT_NEAR(damping, log / std::hypot(std::numbers::pi, log), 1e-12);
  bench.press(2e-6, {0, -0.1 * speed, 0});
  EXPECT_EQ(*bench.memory(0), damping);
}

TEST(WetContact, IsDampedMostWhereNothingApproaches) {
  Bench bench(wet_scene("linear", "clip"), 1e-6);
  bench.add(1e-6, {});
  bench.press(1e-6, {0, 0, 0});
  EXPECT_EQ(*bench.memory(0), DampingTable(true).greatest());
}

TEST(WetContact, StepsBearTheGreatestDamping) {
  const core::Scene scene = wet_scene("hertz_mindlin", "clip");
  core::Scene dry = scene;
  dry.effects.erase("lubrication");
  const Materials materials(scene);
  const PairLaws wet_laws = make_pair_laws(scene, materials), dry_laws = make_pair_laws(dry, materials);
  EXPECT_NEAR(wet_laws.normal->damping_ratio(0) / dry_laws.normal->damping_ratio(0),
              closures::damping_ratio_clipped(0.05) / closures::damping_ratio_clipped(0.9), 1e-9);
  EXPECT_EQ(wet_laws.memory_size(), dry_laws.memory_size() + 1);
}

TEST(WetContact, NeedsAFluid) {
  core::Scene scene = wet_scene("hertz_mindlin", "clip");
  scene.fluid.name = "none";
  EXPECT_THROW((void)make_pair_laws(scene, Materials(scene)), core::CaseError);
}

TEST(DampingTable, IsThatOfTheClosedInversion) {
  const DampingTable clip(true), keep(false);
  for (double log = 0; log < 2.99; log += 0.0137) {
    EXPECT_NEAR(clip(log), closures::damping_ratio_clipped(std::exp(-log)), 3e-6) << log;
    EXPECT_NEAR(keep(log), closures::damping_ratio_kept(std::exp(-log)), 1e-14) << log;
  }
  EXPECT_NEAR(clip(1e9), closures::damping_ratio_clipped(0.05), 1e-12);
  EXPECT_EQ(keep(std::numeric_limits<double>::infinity()), 1);
}

}  // namespace
}  // namespace polybed::dem::test
