// How deep contacts are expected to be, and what the program advises against it, by hand.
#include "dem/overlap_forecast.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/packing.hpp"
#include "dem/scene.hpp"

namespace polybed::dem::test {
namespace {

/// Spheres of 1 mm, 2500 kg/m3, 5 MPa, 0.25: m = 1.308997e-6 kg, E* = 2.666667 MPa.
core::Scene spheres(const char* contact = "hertz_mindlin") {
  core::Scene scene;
  core::Species sphere;
  sphere.name = "a";
  sphere.diameter = 1e-3;
  sphere.density = 2500;
  scene.species = {sphere};
  scene.fluid.name = "none";
  scene.effects["contact"] = contact;
  scene.dem.normal_stiffness = 1000;
  scene.column.size = {0.01, 0.05, 0.01};
  scene.bed.start = {core::StartKind::random};
  scene.bed.particles = {10};
  return scene;
}

OverlapForecast forecast(const core::Scene& scene, double speed) {
  const Materials materials(scene);
  return overlap_forecast(scene, materials, make_pair_laws(scene, materials), speed);
}

constexpr double by_hand = 2e-6;  // relative: seven digits

// One held by others, R* = 0.25 mm, takes m v^2/2 at 1 m/s: (15 m v^2/(16 E* sqrt(R*)))^(2/5) = 6.103634e-5 m. To 0.04
// of the diameter it is (0.06103634/0.04)^(5/2) = 2.876 times as stiff: 14.38, so 15 MPa.
TEST(OverlapForecast, AfterHertz) {
  const OverlapForecast found = forecast(spheres(), 1);
  EXPECT_EQ(found.pair, "a and a");
  EXPECT_NEAR(found.overlap, 6.103634e-5, 6.103634e-5 * by_hand);
  EXPECT_NEAR(found.share, 0.06103634, 0.06103634 * by_hand);
  EXPECT_NEAR(found.stiffening, 2.8763, 2.8763 * 1e-4);
  EXPECT_THAT(found.warning, testing::HasSubstr("use dem.youngs_modulus = \"15 MPa\""));
  EXPECT_EQ(forecast(spheres(), 0.7).warning, "") << "0.7^(4/5) of it is 0.0459, allowed are 0.05";
}

// v sqrt(m/k) = 3.61800e-5 m at 1 m/s; at 2 m/s 0.07236 of the diameter, (0.07236/0.04)^2 = 3.2725 times.
TEST(OverlapForecast, OfLinearSprings) {
  EXPECT_NEAR(forecast(spheres("linear"), 1).overlap, 3.61800e-5, 3.618e-5 * by_hand);
  EXPECT_THAT(forecast(spheres("linear"), 2).warning, testing::HasSubstr("use dem.normal_stiffness = \"3300 N/m\""));
}

// A sphere of twice the diameter weighs 8 times as much: shared by the 4 that it covers 2 times, on one alone all of
// it. Overlaps go with m^(2/5).
TEST(OverlapForecast, OfASingleOneUnderALargeOne) {
  core::Scene scene = spheres();
  scene.species.push_back(scene.species[0]);
  scene.species[1].name = "large";
  scene.species[1].diameter *= 2;
  scene.bed.particles = {10, 10};
  const Materials materials(scene);
  const PairLaws laws = make_pair_laws(scene, materials);
  const OverlapForecast bed = overlap_forecast(scene, materials, laws, 1);
  const OverlapForecast single = overlap_forecast(scene, materials, laws, 1, Met::single);
  EXPECT_EQ(bed.pair, "a and large");
  EXPECT_EQ(single.pair, "a and large");
  EXPECT_NEAR(single.overlap / bed.overlap, std::pow(4, 0.4), 1e-12);
}

// At most 1e13 Pa and 1e12 N/m are accepted: 2e6 times 5 MPa is the first, 2.1e6 times is beyond it.
TEST(OverlapForecast, AdvisesWhatACaseAccepts) {
  core::Scene scene = spheres();
  EXPECT_EQ(stiffer(scene, "a", "wall", 2e6), "dem.youngs_modulus = \"1e+04 GPa\"");
  EXPECT_EQ(stiffer(scene, "a", "wall", 2.1e6), "");
  const std::string told = forecast(scene, 1e3).warning;  // overlap goes with v^(4/5), energy with v^2: 2.876e6 times
  EXPECT_THAT(told, testing::HasSubstr("no stiffness that a case accepts is enough"));
  EXPECT_THAT(told, testing::Not(testing::HasSubstr("GPa")));
  scene = spheres("linear");
  EXPECT_EQ(stiffer(scene, "a", "a", 1e9), "dem.normal_stiffness = \"1e+12 N/m\"");
  EXPECT_EQ(stiffer(scene, "a", "a", 1.1e9), "");
}

// Without speed DMT's pull P goes into the spring alone, 2/5 K d^(5/2) = P d: d = (5 P/(2 K))^(2/3), and the greatest
// is at the wall, whose R* is twice that of two spheres. To 0.04 of the diameter the spring must be stiffer by the
// power 3/2 of the overlaps.
TEST(OverlapForecast, OfASurfaceThatPulls) {
  core::Scene scene = spheres();
  scene.effects["cohesion"] = "dmt";
  scene.dem.cohesion_energy = 5;
  const OverlapForecast found = forecast(scene, 0);
  const double radius = 0.5e-3, pull = 2 * std::numbers::pi * 5 * radius;
  const Materials materials(scene);
  const double modulus = materials.kinds()[std::size_t(materials.wall_kind(0))].youngs_modulus;
  const double overlap = std::pow(2.5 * pull / (4.0 / 3 * modulus * std::sqrt(radius)), 2.0 / 3);
  EXPECT_EQ(found.pair, "a and wall");
  EXPECT_NEAR(found.overlap, overlap, 1e-12 * overlap);
  EXPECT_NEAR(found.stiffening, std::pow(overlap / 4e-5, 1.5), 1e-9);
  EXPECT_THAT(found.warning, testing::HasSubstr("too soft"));
}

TEST(OverlapForecast, NamesTheKeysThatCount) {
  core::Scene scene = spheres();
  core::Species hard = scene.species[0];
  hard.name = "b";
  hard.youngs_modulus = 8e6;
  scene.species.push_back(hard);
  EXPECT_EQ(stiffer(scene, "a", "a", 1.01), "dem.youngs_modulus = \"5.1 MPa\"");
  EXPECT_EQ(stiffer(scene, "b", "b", 200), "youngs_modulus of b = \"1.6 GPa\"");
  EXPECT_EQ(stiffer(scene, "b", "wall", 2), "youngs_modulus of b = \"16 MPa\" and dem.youngs_modulus = \"10 MPa\"");
  scene.contact_pairs.push_back({{"b", "a"}, 1e5, {}, {}, {}});
  EXPECT_EQ(stiffer(scene, "b", "b", 200), "youngs_modulus of b = \"1.6 GPa\"");
  EXPECT_THAT(stiffer(scene, "a", "b", 2), testing::HasSubstr("[[contact_pair]] of a and b = \"200 kPa\""));
}

Speeds speeds(const core::Scene& scene) { return known_speeds(scene, Materials(scene), box_of(scene), {}); }

// A fall through 50 mm is sqrt(2 g h) = 0.990454 m/s; what 8 times the mass passes on, 1.9 8/9 = 1.688889 of it.
TEST(Speeds, OfAFall) {
  core::Scene scene = spheres();
  EXPECT_NEAR(speeds(scene).impact, 0.990454, 0.990454 * by_hand);
  EXPECT_EQ(speeds(scene).greatest, speeds(scene).impact) << "0.95 of it";
  scene.species.push_back(scene.species[0]);
  scene.species[1].diameter *= 2;
  scene.bed.particles = {10, 10};
  EXPECT_NEAR(speeds(scene).greatest, 1.688889 * 0.990454, by_hand * 1.68);
  scene.dem.greatest_speed = 3;
  EXPECT_EQ(speeds(scene).impact, 3);
}

// 1000 spheres at a fraction of 0.5 fill pi/6 1e-6/(0.5 1e-4) m = 10.47198 mm of the column: 0.453277 m/s.
TEST(Speeds, OfAFallFromTheTopOfTheBed) {
  core::Scene scene = spheres();
  scene.bed.start = {core::StartKind::mixed};
  scene.bed.particles = {1000};
  scene.bed.start_solids_fraction = 0.5;
  EXPECT_NEAR(start_height(scene, Materials(scene), box_of(scene)), 10.47198e-3, 10.47198e-3 * by_hand);
  EXPECT_NEAR(speeds(scene).impact, 0.453277, 0.453277 * by_hand);
}

// 0.1 m/s between particles at 0.6 is 0.25 m/s, four times that 1 m/s: spheres as heavy as the liquid fall with
// nothing.
TEST(Speeds, OfAChannelThroughABed) {
  core::Scene scene = spheres();
  scene.column.size[1] = 1;
  scene.fluid.name = "liquid";
  scene.fluid.density = 2500;
  scene.fluid.viscosity = 1e-3;
  scene.bed.solids_fraction = 0.6;
  scene.inlet.superficial_velocity = {{0, 0.1}};
  EXPECT_NEAR(speeds(scene).greatest, 1, by_hand);
  scene.bed.solids_fraction = 0.2;
  EXPECT_NEAR(speeds(scene).greatest, 0.5, by_hand);
}

// Under a lid 0.1 m/s of 1 cm2 leave through 0.3 cm2; 1250 Pa less outside make 1 m/s of a liquid of 2500 kg/m3. Twice
// that, as for other flows.
TEST(Speeds, OfAnOverflow) {
  core::Scene scene = spheres();
  scene.column.dimensions = 3;
  scene.column.size[1] = 1;
  scene.fluid.name = "liquid";
  scene.fluid.density = 2500;
  scene.fluid.viscosity = 1e-3;
  scene.inlet.superficial_velocity = {{0, 0.1}};
  scene.discharges = {{core::ColumnFace::right, {2e-3, 0.9}, {8e-3, 0.905}, {}, 0.0}};
  scene.column.outlet = core::Outlet::lid;
  EXPECT_NEAR(speeds(scene).greatest, 2 / 3.0, by_hand);
  scene.column.outlet = core::Outlet::screen;
  scene.discharges[0].pressure = -1250;
  EXPECT_NEAR(speeds(scene).greatest, 2, 2 * by_hand);
}

}  // namespace
}  // namespace polybed::dem::test
