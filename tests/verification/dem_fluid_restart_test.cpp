// A run taken up again has the bits of one that went through, with the fluid between the particles.
#include "core/numerics/random.hpp"
#include "scenes/dem_scenes.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::scenes {
namespace {

/// A small bed of two sizes in rising water, dropped from a lattice.
core::Scene small_bed(const std::string& integrator) {
  core::Scene scene = wet_box(1.2e-3, 2500, water, {12e-3, 24e-3, 6e-3}, {5, 10, 1});
  scene.species.push_back(sphere("b", 0.4e-3, {1e6, 0.25, 1400}));
  scene.column.closed = false;
  scene.column.gravity = 9.81;
  scene.inlet.superficial_velocity = {{0.0, 0.02}, {0.02, 0.05}};
  scene.effects["drag"] = "cello";
  scene.effects["added_mass"] = "zuber";
  scene.effects["fluid_stress"] = "newtonian";
  scene.dem.integrator = core::choice_of<core::DemIntegrator>(integrator);
  scene.dem.fluid_every = 16;
  scene.dem.greatest_speed = 0.2;
  return scene;
}

std::vector<Bead> dropped() {
  std::vector<Bead> beads = cubic_lattice("a", 1.5e-3, {12e-3, 15e-3, 6e-3});
  for (std::uint64_t n = 0; n < beads.size(); ++n) {
    if (n % 3 == 0) beads[n].species = "b";
    for (std::size_t k = 0; k < 3; ++k) beads[n].x[k] += 0.2e-3 * (core::uniform(3, k, n) - 0.5);
  }
  return beads;
}

void expect_same(const core::Checkpoint& one, const core::Checkpoint& other) {
  EXPECT_EQ(one.integers, other.integers);
  EXPECT_EQ(one.numbers, other.numbers);
  ASSERT_EQ(one.arrays.size(), other.arrays.size());
  for (const auto& [name, values] : one.arrays) {
    ASSERT_TRUE(other.arrays.contains(name)) << name;
    EXPECT_EQ(values, other.arrays.at(name)) << name;
  }
}

/// N steps, a checkpoint, N more; and the same from the checkpoint.
void resumes(const core::Scene& scene, std::int64_t steps) {
  Beads through(scene, dropped()), again(scene, dropped());
  through.steps(steps);
  through.model.restart();
  const core::Checkpoint middle = through.model.checkpoint();
  again.model.resume(middle);
  expect_same(again.model.checkpoint(), middle);
  EXPECT_EQ(again.model.coupling()->pressure_drop(), through.model.coupling()->pressure_drop());
  for (Beads* run : {&through, &again}) run->steps(steps);
  EXPECT_GT(through.model.coupling()->steps(), 1U);
  expect_same(again.model.checkpoint(), through.model.checkpoint());
  EXPECT_EQ(again.model.coupling()->pressure_drop(), through.model.coupling()->pressure_drop());
}

TEST(DemRestart, HasTheSameBitsBetweenStepsOfTheFluid) {
  resumes(small_bed("thesis"), 480);  // 30 steps of the fluid
  resumes(small_bed("synchronised"), 480);
}

TEST(DemRestart, HasTheSameBitsAmidAStepOfTheFluid) {
  resumes(small_bed("thesis"), 487);
  resumes(small_bed("synchronised"), 487);
}

TEST(DemRestart, HasTheSameBitsUnderAKernelAndInACompressibleFluid) {
  core::Scene scene = small_bed("thesis");
  scene.dem.kernel = core::Kernel::diffusion;
  scene.column.cells = {10, 20, 1};
  resumes(scene, 487);
  core::Scene tait = small_bed("synchronised");
  tait.fluid.equation_of_state = core::Compressibility::tait;
  resumes(tait, 487);
}

}  // namespace
}  // namespace polybed::scenes
