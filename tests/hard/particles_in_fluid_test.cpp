// The textbook treatments of particles are what they say: beside what each replaces they do as the product does.
#include <gtest/gtest.h>

#include <set>

#include "hard/hard_case.hpp"
#include "hard/naive/particles.hpp"
#include "hard/naive/spheres.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::hard {
namespace {

using scenes::Bead;

// The runs that treatments ride on are sound: without one they do as the product does, to round-off of 160 steps.
TEST(Naive, ParticlesWithoutATreatmentDoAsTheProduct) {
  for (const std::string added : {"none", "half"}) {
    core::Scene scene = scenes::wet_box(1e-3, 2500, scenes::water, {20e-3, 25e-3, 20e-3}, {4, 5, 4});
    scene.dem.fluid_every = 16;
    scene.column.gravity = 9.81;
    scene.effects["added_mass"] = added;
    scene.dem.fixed_step = 2e-5;
    const std::vector<Bead> beads{{"a", {9e-3, 14e-3, 11e-3}, {0.1, 0, 0.05}}, {"a", {12e-3, 8e-3, 6e-3}, {0, 0.2, 0}}};
    scenes::Beads product(scene, beads);
    naive::ParticleRun run("nothing", scene, naive::particles_of(scene, beads), 2e-5);
    for (int n = 0; n < 10; ++n) run.step();
    product.steps(160);
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(run.particles().motion[i].v[k], product.motion(std::int64_t(i)).v[k], 1e-13) << added;
  }
}

// Of an oblique rebound from the floor the textbook's engine has the normal part to what its steps leave (200 to the
// contact), and momentum and spin as a sphere's impulse at its lowest point gives them: 5/2 v_t/R - w is kept.
TEST(Naive, SpheresWithoutATreatmentReboundAsTheyShould) {
  core::Scene scene = scenes::dry_box(0.5e-3, {5e6, 0.25, 2500}, {0.02, 0.02, 0.02});
  core::set_restitution(scene, 1);
  scene.dem.steps_per_contact = 200;
  const std::vector<Bead> start{{"a", {0.01, 0.5001e-3, 0.01}, {0.2, -0.5, 0}}};
  scene.dem.fixed_step = scenes::Beads(scene, start).dt();
  naive::Spheres run("nothing", scene, start);
  run.steps(2000);
  EXPECT_NEAR(run.motion(0).v[1], 0.5, 1e-3);
  EXPECT_NEAR(run.motion(0).v[0] - 0.4 * 0.5e-3 * run.motion(0).w[2], 0.2, 1e-9);
  EXPECT_LT(run.motion(0).v[0], 0.2);
}

// The engine is one of its own: what makes a treatment fail a case is the treatment, since without one it passes.
TEST(Naive, SpheresWithoutATreatmentPassWhatTreatmentsFail) {
  const std::set<std::string> asked{"D6", "D8", "D9", "D11"};
  std::size_t seen = 0;
  for (const HardCase& one : catalogue()) {
    if (!asked.contains(one.id)) continue;
    Trial trial({"explicit", "limited", "nothing"});
    const Result result = trial.judge(one.work);
    EXPECT_EQ(name_of(result.outcome), "PASS") << one.id << " " << result.broken << " " << result.cause;
    ++seen;
  }
  EXPECT_EQ(seen, asked.size());
}

}  // namespace
}  // namespace polybed::hard
