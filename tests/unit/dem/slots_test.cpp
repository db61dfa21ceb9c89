// Laws as slots: what is not named is not there, what contradicts itself is refused, batches of any size have the same
// bits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bench.hpp"
#include "closures/cohesion_jkr.hpp"
#include "core/error.hpp"
#include "dem/ledger.hpp"

namespace polybed::dem::test {
namespace {

PairLaws laws_of(const core::Scene& scene) { return make_pair_laws(scene, Materials(scene)); }

TEST(Slots, AnAbsentLawHasNothing) {
  const PairLaws bare = laws_of(scene_of({{"contact", "hertz"}}));
  EXPECT_EQ(bare.tangential, nullptr);
  EXPECT_EQ(bare.rolling, nullptr);
  EXPECT_EQ(bare.cohesion, nullptr);
  EXPECT_EQ(bare.bridge, nullptr);
  EXPECT_EQ(bare.memory_size(), 0);
  EXPECT_EQ(bare.reach(), 0);
  EXPECT_EQ(Ledger::memory_size(bare), 2);
}

TEST(Slots, EachLawHasItsOwnMemory) {
  core::Scene scene = scene_of({});
  scene.dem.rolling_friction = 0.1;
  scene.dem.cohesion_energy = 0.05;
  scene.material.hamaker_constant = 1e-19;
  EXPECT_EQ(laws_of(scene).memory_size(), 3);
  EXPECT_EQ(Ledger::memory_size(laws_of(scene)), 6);
  scene.dem.tangential = core::Tangential::mindlin;
  EXPECT_EQ(laws_of(scene).memory_size(), 4);
  scene.dem.tangential = core::Tangential::mindlin_deresiewicz;
  EXPECT_EQ(laws_of(scene).memory_size(), 8);
  scene.effects["rolling"] = "cdt";
  EXPECT_EQ(laws_of(scene).memory_size(), 8);
  EXPECT_EQ(Ledger::memory_size(laws_of(scene)), 10);
  scene.effects["rolling"] = "epsd";
  EXPECT_EQ(laws_of(scene).memory_size(), 11);
  scene.effects["cohesion"] = "van_der_waals";
  EXPECT_EQ(laws_of(scene).memory_size(), 11);
  for (const char* jumping : {"dmt", "jkr"}) {
    scene.effects["cohesion"] = jumping;
    EXPECT_EQ(laws_of(scene).memory_size(), 12);
    EXPECT_EQ(laws_of(scene).contact_memory(), 11);
  }
  EXPECT_LE(laws_of(scene).memory_size() + Ledger::memory_size(laws_of(scene)), ContactBatch::most_memory);
  scene.material.surface_tension = 0.07;
  scene.material.liquid_fraction = 0.01;
  scene.effects["liquid_bridge"] = "willett";
  EXPECT_EQ(laws_of(scene).memory_size(), 13);
  EXPECT_EQ(laws_of(scene).contact_memory(), 11);
  scene.fluid.name = "test gas";
  scene.fluid.density = 1.2;
  scene.fluid.viscosity = 1.8e-5;
  for (const char* law : {"wet_restitution", "film"}) {
    scene.effects["lubrication"] = law;
    EXPECT_LE(laws_of(scene).memory_size() + Ledger::memory_size(laws_of(scene)), ContactBatch::most_memory) << law;
  }
}

TEST(Slots, OnlyWhatPullsAcrossAGapReaches) {
  core::Scene scene = scene_of({{"cohesion", "dmt"}});
  scene.dem.cohesion_energy = 0.05;
  scene.material.hamaker_constant = 1e-19;
  scene.dem.cohesion_gap = 1e-9;
  // A jump is found up to a step after it: three times the greatest overlap, a tenth of 5 mm, in 20 steps.
  const double step = 7.5e-5;
  EXPECT_NEAR(laws_of(scene).reach(), step, 1e-19);
  scene.effects["cohesion"] = "van_der_waals";
  EXPECT_NEAR(laws_of(scene).reach(), 1e-6, 1e-18);  // 1000 z_0
  scene.effects["cohesion"] = "jkr";
  // The softest pair of the largest R*: a sphere and the wall.
  const Materials materials(scene);
  const PairMaterial& k = materials.kinds()[1];
  EXPECT_NEAR(laws_of(scene).reach(), closures::jkr_scales(0.05, k.youngs_modulus, k.radius).gap + step, 1e-19);
}

std::string refused(const core::Scene& scene) {
  try {
    (void)laws_of(scene);
  } catch (const core::CaseError& error) {
    return error.what();
  }
  return "";
}

TEST(Slots, ContradictionsAreToldByTheirKeys) {
  using testing::HasSubstr;
  EXPECT_THAT(refused(scene_of({{"contact", "none"}})), HasSubstr("effects.contact"));
  EXPECT_THAT(refused(scene_of({{"contact", "linear"}})), HasSubstr("dem.normal_stiffness"));
  EXPECT_THAT(refused(scene_of({{"rolling", "cdt"}})), HasSubstr("dem.rolling_friction"));
  EXPECT_THAT(refused(scene_of({{"cohesion", "dmt"}})), HasSubstr("dem.cohesion_energy"));
  EXPECT_THAT(refused(scene_of({{"cohesion", "jkr"}})), HasSubstr("dem.cohesion_energy"));
  EXPECT_THAT(refused(scene_of({{"cohesion", "van_der_waals"}})), HasSubstr("dem.hamaker_constant"));
  core::Scene scene = scene_of({{"rolling", "cdt"}, {"contact", "hertz"}});
  scene.dem.rolling_friction = 0.1;
  EXPECT_THAT(refused(scene), HasSubstr("nothing rotates"));
  scene.effects["contact"] = "hertz_mindlin";
  scene.dem.rolling_damping = 0.3;
  EXPECT_THAT(refused(scene), HasSubstr("dem.rolling_damping"));
  scene.effects["rolling"] = "epsd";
  EXPECT_EQ(refused(scene), "");
  scene.dem.tangential = core::Tangential::linear;
  EXPECT_THAT(refused(scene), HasSubstr("dem.tangential = \"linear\""));
  scene.effects["contact"] = "linear";
  scene.dem.normal_stiffness = 1000;
  EXPECT_EQ(refused(scene), "");
  scene.dem.tangential = core::Tangential::mindlin;
  EXPECT_THAT(refused(scene), HasSubstr("radius of a contact"));
  scene.dem.tangential = core::Tangential::hdd;
  scene.effects["cohesion"] = "jkr";
  scene.dem.cohesion_energy = 0.05;
  EXPECT_THAT(refused(scene), HasSubstr("in place of Hertz"));
}

/// Velocities and spins of `count` spheres from the k-th on, all of different impacts, after 60 steps.
std::vector<Motion> after_impacts(const core::Scene& scene, int from, int count) {
  Bench bench(scene, 4e-6);
  for (int k = from; k < from + count; ++k)
    bench.add(1e-7 * (k % 5) - 1e-7, {0.3 * std::cos(k), -0.5 - 0.01 * k, 0.2 * std::sin(k)}, {1.0 * k, 5, 3});
  for (int n = 0; n < 60; ++n) bench.step();
  return bench.particles.motion;
}

TEST(Slots, BatchesOfAnySizeHaveTheSameBits) {
  for (const char* tangential : {"hdd", "mindlin", "mindlin_deresiewicz"})
    for (const char* rolling : {"none", "cdt", "epsd"})
      for (const char* cohesion : {"none", "dmt", "jkr", "van_der_waals"}) {
        core::Scene scene = scene_of({{"rolling", rolling}, {"cohesion", cohesion}});
        scene.dem.tangential = core::choice_of<core::Tangential>(tangential);
        scene.dem.rolling_friction = 0.1;
        scene.dem.cohesion_energy = 5;
        scene.material.hamaker_constant = 1e-14;
        scene.dem.cohesion_gap = 1e-9;
        scene.dem.max_overlap = 1;  // such an attraction presses deep: what stops a run is not the matter here
        const std::vector<Motion> all = after_impacts(scene, 0, 70);
        EXPECT_NE(all[3].v, all[4].v);
        for (const auto& [from, count] : {std::pair(0, 1), {69, 1}, {3, 7}, {5, 64}}) {
          const std::vector<Motion> some = after_impacts(scene, from, count);
          for (int k = 0; k < count; ++k) {
            EXPECT_EQ(some[std::size_t(k)].v, all[std::size_t(from + k)].v) << tangential << rolling << cohesion;
            EXPECT_EQ(some[std::size_t(k)].w, all[std::size_t(from + k)].w) << tangential << rolling << cohesion;
          }
        }
      }
}

}  // namespace
}  // namespace polybed::dem::test
