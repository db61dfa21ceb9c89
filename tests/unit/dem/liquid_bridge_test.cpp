// Liquid bridges through the engine: they form where surfaces touch, pull, and rupture; their energy is counted.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "closures/contact_hertz.hpp"
#include "closures/liquid_bridge_willett.hpp"
#include "closures/sphere.hpp"
#include "core/error.hpp"
#include "pair_bench.hpp"

namespace polybed::dem::test {
namespace {

constexpr double tension = 0.072, fraction = 0.02;

core::Scene wet(double angle = 0, const char* cohesion = "none") {
  core::Scene scene = scene_of({{"liquid_bridge", "willett"}, {"cohesion", cohesion}});
  scene.fluid.name = "none";
  scene.material.surface_tension = tension;
  scene.material.contact_angle = angle;
  scene.material.liquid_fraction = fraction;
  scene.dem.cohesion_energy = 0.5;
  return scene;
}

double hertz(const PairMaterial& k, double overlap) {
  return overlap > 0 ? closures::hertz_greatest_force(closures::hertz_coefficient(k.youngs_modulus, k.radius), overlap)
                     : 0;
}

// Round-off of an overlap of 1e-5 m that is the difference of places of 2.5e-3 m: 1e-16 2.5e-3/1e-5 of it.
constexpr double round_off = 1e-12;

TEST(LiquidBridge, FormsAtTheTouchAndPullsUntilItRuptures) {
  Bench bench(wet(30), 1e-6);
  bench.add(0, {});
  // A wall: R = 2 R_i = 5 mm, half of the sphere's liquid.
  const double radius = 5e-3, volume = 0.5 * fraction * closures::sphere_volume(2.5e-3);
  const double angle = std::numbers::pi / 6;
  const double pull = closures::liquid_bridge_pull(radius, tension, angle);
  EXPECT_NEAR(pull, 2 * std::numbers::pi * 5e-3 * 0.072 * std::sqrt(0.75), 1e-17);
  const double rupture = (1 + angle / 2) * std::cbrt(volume), stretch = std::sqrt(radius / volume);
  EXPECT_DOUBLE_EQ(bench.laws.reach(), rupture + longest_step(wet(), bench.materials));
  const auto pressed = [&](double overlap) { return bench.press(overlap, {})[1]; };
  EXPECT_EQ(pressed(-0.1 * rupture), 0);  // has not touched yet
  for (const double overlap : {1e-5, 3e-5, 1e-7, -0.01 * rupture, -0.5 * rupture, -0.99 * rupture}) {
    const double expected = hertz(bench.kind(), overlap) + closures::liquid_bridge_force(pull, stretch, -overlap);
    EXPECT_NEAR(pressed(overlap), expected, round_off * (std::abs(expected) + pull)) << overlap;
  }
  EXPECT_EQ(pressed(-1.01 * rupture), 0);
  EXPECT_EQ(pressed(-0.5 * rupture), 0);  // ruptured
  EXPECT_LT(pressed(1e-9), -0.9 * pull);  // and there again
}

TEST(LiquidBridge, OfUnequalSpheresTakesTheFilmsThatTheyCover) {
  core::Scene scene = wet();
  scene.species.push_back(scene.species[0]);
  scene.species[1].name = "b";
  scene.species[1].diameter = 1e-3;
  const Materials materials(scene);
  const PairLaws laws = make_pair_laws(scene, materials);
  // The largest reach is that of the large sphere at the wall.
  EXPECT_DOUBLE_EQ(laws.reach(),
                   std::cbrt(0.5 * fraction * closures::sphere_volume(2.5e-3)) + longest_step(scene, materials));
  ContactBatch batch;
  batch.count = 1;
  batch.kind[0] = materials.kind(0, 1);
  batch.overlap[0] = 0;
  laws.bridge->act(batch, 0);
  EXPECT_NEAR(batch.normal[0], -2 * std::numbers::pi * 2 * (2.5e-3 * 0.5e-3 / 3e-3) * tension, 1e-17);
  // V: caps of half-angles asin(1/6) and asin(5/6).
  const double volume = fraction * (closures::sphere_volume(2.5e-3) * 0.5 * (1 - std::sqrt(35.0) / 6) +
                                    closures::sphere_volume(0.5e-3) * 0.5 * (1 - std::sqrt(11.0) / 6));
  const double rupture = std::cbrt(volume);
  batch.normal[0] = 0;
  batch.overlap[0] = -0.999999 * rupture;
  laws.bridge->act(batch, 0);
  EXPECT_LT(batch.normal[0], 0);
  batch.normal[0] = 0;
  batch.overlap[0] = -1.000001 * rupture;
  laws.bridge->act(batch, 0);
  EXPECT_EQ(batch.normal[0], 0);
}

/// Speed of parting of two spheres after an impact at a speed, and what the ledger has counted.
struct Impact {
  double speed = 0, taken = 0;
  bool parted = false;
};

Impact impact(double speed, double dt, bool synchronised) {
  core::Scene scene = wet();
  scene.effects["contact"] = "hertz";
  core::set_restitution(scene, 1);
  PairBench bench(scene, dt, 0.3 * speed * dt, speed, synchronised);
  const double reach = bench.laws.reach();
  Impact after;
  for (int n = 0; n < 100000 && !after.parted; ++n) {
    bench.step();
    after.parted = bench.speed() < 0 && bench.gap() > 1.1 * reach;
  }
  after.speed = -bench.speed();
  after.taken = bench.dissipated();
  return after;
}

TEST(LiquidBridge, TakesItsEnergyFromAnImpact) {
  // The closed form's integral from the touch to rupture; m*/2 (v^2 - v'^2) is it.
  const Materials materials(wet());
  const PairMaterial& k = materials.kinds()[0];
  const double volume = 2 * fraction * closures::sphere_volume(2.5e-3) * closures::covered_share(1, 1);
  const double pull = closures::liquid_bridge_pull(2.5e-3, tension, 0), stretch = std::sqrt(2.5e-3 / volume);
  const double energy = -closures::liquid_bridge_energy(pull, stretch, std::cbrt(volume), 0);
  const double sticking = std::sqrt(2 * energy / k.mass);
  for (const bool synchronised : {false, true}) {
    const Impact out = impact(2 * sticking, 5e-7, synchronised);
    ASSERT_TRUE(out.parted);
    // The jump at the touch errs by up to the pull over half a step's way, 4e-8 m; the energy is the pull over 1.7e-4
    // m.
    EXPECT_NEAR(out.speed / sticking, std::sqrt(3.0), 5e-4);
    EXPECT_NEAR(out.taken / energy, 1, 5e-4);
  }
  EXPECT_FALSE(impact(0.9 * sticking, 5e-6, false).parted);
}

TEST(LiquidBridge, StandsBesideTheAttractionOfSurfaces) {
  Bench both(wet(0, "jkr"), 1e-6), bridge(wet(), 1e-6), neck(wet(0, "jkr"), 1e-6);
  neck.laws.bridge.reset();
  for (Bench* bench : {&both, &bridge, &neck}) bench->add(0, {});
  for (const double overlap : {-1e-6, 2e-5, 1e-6, -1e-6, -3e-4, -1e-6}) {
    const double sum = bridge.press(overlap, {})[1] + neck.press(overlap, {})[1] - hertz(both.kind(), overlap);
    EXPECT_NEAR(both.press(overlap, {})[1], sum, 1e-11 * (std::abs(sum) + 4e-3)) << overlap;
  }
}

TEST(LiquidBridge, IsAbsentWhereNothingCallsForIt) {
  core::Scene scene = wet();
  const Materials materials(scene);
  const PairLaws with = make_pair_laws(scene, materials);
  scene.effects.erase("liquid_bridge");
  const PairLaws without = make_pair_laws(scene, materials);
  EXPECT_EQ(without.bridge, nullptr);
  EXPECT_EQ(without.reach(), 0);
  EXPECT_EQ(with.memory_size(), without.memory_size() + 1);
  EXPECT_EQ(Ledger::memory_size(with), Ledger::memory_size(without));
}

TEST(LiquidBridge, IsRefusedInALiquidAndWithoutOne) {
  const auto made = [](const core::Scene& scene) { return make_pair_laws(scene, Materials(scene)); };
  core::Scene scene = wet();
  EXPECT_NO_THROW((void)made(scene));
  scene.fluid.name = "test gas";
  scene.fluid.density = 1.2;
  scene.fluid.viscosity = 1.8e-5;
  EXPECT_NO_THROW((void)made(scene));
  scene.fluid.density = 1000;
  EXPECT_THROW((void)made(scene), core::CaseError);
  scene = wet();
  scene.material.surface_tension.reset();
  EXPECT_THROW((void)made(scene), core::CaseError);
  scene = wet();
  scene.material.liquid_fraction = 0;
  EXPECT_THROW((void)made(scene), core::CaseError);
}

}  // namespace
}  // namespace polybed::dem::test
