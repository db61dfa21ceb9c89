// Particles and fluid at rest, and how a sphere begins to move: weight, buoyancy and added mass.
#include "core/case/grading.hpp"
#include "core/numerics/random.hpp"
#include "scenes/dem_scenes.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::scenes {
namespace {

constexpr double g = 9.81;

/// Spheres of 1 mm at random places of a cubic lattice's cells, so that none touch.
std::vector<Bead> strewn(const dem::Vector& size, double spacing) {
  std::vector<Bead> beads = cubic_lattice("a", spacing, size);
  for (std::uint64_t n = 0; n < beads.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k) beads[n].x[k] += (spacing - 1.01e-3) * (core::uniform(3, k, n) - 0.5);
  return beads;
}

core::Scene suspension(double density, const dem::Vector& size) {
  core::Scene scene = wet_box(1e-3, density, water, size, {4, 6, 4});
  scene.column.gravity = g;
  scene.effects["drag"] = "cello";
  scene.effects["added_mass"] = "zuber";
  scene.dem.fixed_step = 1e-4;
  scene.dem.fluid_every = 10;
  return scene;
}

// Unevenly strewn, of the fluid's density: nothing moves, whatever the voidage is where, and in graded layers.
class RestingSuspension : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(EvenAndGraded, RestingSuspension, testing::Bool());

TEST_P(RestingSuspension, StaysIfNeutrallyBuoyant) {
  const dem::Vector size{10e-3, 15e-3, 10e-3};
  core::Scene scene = suspension(water.density, size);
  if (GetParam()) {
    scene.column.layers = core::graded_layers(size[1], 6, 5e-3, 1.2);
    scene.column.cells[1] = int(scene.column.layers.size());
  }
  Beads beads(scene, strewn(size, 1.25e-3));
  beads.steps(200);
  double most = 0;
  for (std::size_t i = 0; i < beads.model.particles().owned; ++i)
    for (const double v : beads.model.particles().motion[i].v) most = std::max(most, std::abs(v));
  compare("greatest speed after 0.02 s, m/s", most, 0, 1e-12, 1);
  // Of the weight of the liquid over the box.
  compare("pressure drop", beads.model.coupling()->pressure_drop(), 0, 1e-12, water.density * g * size[1]);
}

// At rest on the bottom a sphere presses with its weight less that of the liquid it displaces.
TEST(DemRest, ASphereWeighsLessByWhatItDisplaces) {
  core::Scene scene = wet_box(2e-3, 2500, water, {30e-3, 30e-3, 30e-3}, {5, 5, 5});
  scene.column.gravity = g;
  core::set_restitution(scene, 0.2);
  core::set_friction(scene, 0);
  scene.dem.fluid_every = 16;
  Beads beads(scene, {{"a", {15e-3, 0.999e-3, 15e-3}}});
  beads.until(0.5);
  const double weight = (2500 - water.density) * pi / 6 * 8e-9 * g;
  // What is left of its motion after 0.5 s.
  compare("force of the floor", beads.force(0)[1], weight, 1e-6);
  EXPECT_LT(std::abs(beads.motion(0).v[1]), 1e-9);
}

// a = g (rho_f - rho_p)/(rho_p + C_m rho_f) at first. The fluid it pushes aside moves in its averaged cells too: a
// share V/psi of the whole, psi the cell, which is why the cells here are 20 diameters wide (6.5e-5).
TEST(DemRest, ALightSphereIsReleased) {
  const double d = 1e-3;
  for (const double ratio : {2.5, 1.5, 1.0, 0.5, 0.1, 0.001}) {
    const double density = ratio * water.density;
    core::Scene scene = wet_box(d, density, water, {100e-3, 100e-3, 100e-3}, {5, 5, 5});
    scene.column.gravity = g;
    scene.effects = {{"contact", "hertz_mindlin"}, {"added_mass", "half"}};
    scene.dem.fixed_step = 2e-5;
    scene.dem.greatest_speed = 5;
    for (const int every : {1, 16}) {
      scene.dem.fluid_every = every;
      Beads beads(scene, {{"a", {47e-3, 52e-3, 51e-3}}});
      beads.steps(48);
      const double expected = g * (water.density - density) / (density + 0.5 * water.density);
      compare(fmt::format("ratio {}, {} steps to one of the fluid", ratio, every),
              beads.motion(0).v[1] / (48 * *scene.dem.fixed_step), expected, 1e-4, std::max(std::abs(expected), 1e-9));
    }
  }
}

}  // namespace
}  // namespace polybed::scenes
