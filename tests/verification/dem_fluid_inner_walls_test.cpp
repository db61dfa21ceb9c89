// Particles in a fluid between walls inside the column: at rest, in the balance of pressure and weight, resumed.
#include "core/numerics/inner_walls.hpp"
#include "dem/packing.hpp"
#include "scenes/round_beads.hpp"

namespace polybed::scenes {
namespace {

constexpr double wide = 24e-3, deep = 5e-3;

core::InnerWall rod(double x, double y, double diameter) { return {{x, y}, {x, y}, core::WallShape::rod, diameter}; }

/// Around a rod of 8 mm across a flat box, or a draft tube of three dimensions.
core::Scene between_walls(double density, bool tube, core::Kernel kernel) {
  const bool fine = kernel == core::Kernel::diffusion;
  core::Scene scene = wet_box(bead_diameter, density, water, {wide, high, tube ? wide : deep},
                              {fine ? 16 : 12, fine ? 32 : 24, tube ? (fine ? 16 : 12) : 1});
  scene.walls = {rod(11e-3, 17e-3, 8e-3)};
  if (tube) scene.walls = {{{12e-3, 12e-3}, {12e-3, 34e-3}, core::WallShape::cylinder, 3e-3}};
  scene.column.gravity = 9.81;
  scene.dem.fixed_step = 1e-4;
  scene.dem.fluid_every = 10;
  scene.dem.kernel = kernel;
  return scene;
}

/// Those of a lattice that lie outside the walls, between two heights.
std::vector<Bead> beside(const core::Scene& scene, double from, double to) {
  std::vector<Bead> beads;
  const core::InnerWalls walls(scene.walls, scene.column.size, false);
  std::uint64_t n = 0;
  for (Bead& bead : cubic_lattice("a", bead_spacing, scene.column.size)) {
    for (std::size_t k = 0; k < 3; ++k)
      bead.x[k] += 0.8 * (bead_spacing - 1.01 * bead_diameter) * (core::uniform(3, k, n) - 0.5);
    ++n;
    bool inside = true;
    for (std::size_t k = 0; k < (scene.column.dimensions == 3 ? 3U : 2U); ++k)
      inside = inside && bead.x[k] > 0.5 * bead_diameter && bead.x[k] < scene.column.size[k] - 0.5 * bead_diameter;
    if (inside && walls.nearest(bead.x).distance > 0.5 * bead_diameter && bead.x[1] > from && bead.x[1] < to)
      beads.push_back(bead);
  }
  return beads;
}

template <class Body>
void for_each_scene(double density, Body&& body) {
  for (const core::Kernel kernel : {core::Kernel::bilinear, core::Kernel::diffusion})
    for (const bool tube : {false, true}) {
      SCOPED_TRACE(fmt::format("{}, {}", core::name_of(kernel), tube ? "tube" : "rod"));
      body(between_walls(density, tube, kernel));
    }
}

double fastest(const dem::Model& model) {
  double most = 0;
  for (std::size_t i = 0; i < model.particles().owned; ++i)
    for (const double v : model.particles().motion[i].v) most = std::max(most, std::abs(v));
  return most;
}

TEST(DemBetweenWalls, ANeutrallyBuoyantSuspensionStays) {
  for_each_scene(water.density, [](core::Scene scene) {
    scene.effects["added_mass"] = "zuber";
    scene.effects["drag"] = "cello";
    Beads bed(scene, beside(scene, 0, high));
    bed.steps(20);
    compare("greatest speed after 2 ms, m/s", fastest(bed.model), 0, 1e-12, 1);
    compare("solids in the cells", solids_of(bed.model), double(bed.model.particles().owned) * bead_volume, 1e-9);
  });
}

// A bed that has fallen on a rod and past it, in a closed box of water: nothing moves, and the water is at rest.
TEST(DemBetweenWalls, ASettledBedRests) {
  core::Scene scene = between_walls(2500, false, core::Kernel::bilinear);
  scene.effects["drag"] = "cello";
  scene.dem.fixed_step = 2e-5;
  scene.dem.fluid_every = 16;
  core::set_restitution(scene, 0.3);
  Beads bed(scene, beside(scene, 0, 30e-3));
  bed.steps(50'000);
  const double weight = double(bed.model.particles().owned) * bead_volume * 1500 * 9.81 / (wide * deep);
  compare("greatest speed after 1 s, m/s", fastest(bed.model), 0, 1e-4, 1);
  compare("pressure drop over the weight", bed.model.coupling()->pressure_drop() / weight, 0, 1e-3, 1);
}

// Spheres carried past the wall and out of the top; resumed with the same bits.
TEST(DemBetweenWalls, CountsWhatLeavesAndResumesWithTheSameBits) {
  core::Scene scene = between_walls(1010, false, core::Kernel::bilinear);
  scene.inlet.superficial_velocity = {{0.0, 0.1}};
  scene.column.closed = false;
  scene.column.outlet = core::Outlet::open;
  scene.effects["drag"] = "cello";
  Beads through(scene, beside(scene, 2e-3, 47e-3)), again(scene, beside(scene, 2e-3, 47e-3));
  through.run_while([&] { return through.model.outflow()->number[0] < 20; }, 10'000);
  through.steps(10 - through.model.steps() % 10);
  through.model.restart();
  const core::Checkpoint middle = through.model.checkpoint();
  again.model.resume(middle);
  for (Beads* run : {&through, &again}) run->steps(300);
  EXPECT_EQ(through.model.checkpoint().arrays, again.model.checkpoint().arrays);
}

// Placed between the walls at the start, and none in them.
TEST(DemBetweenWalls, AStartIsBetweenThem) {
  for (const bool tube : {false, true}) {
    core::Scene scene = between_walls(2500, tube, core::Kernel::bilinear);
    scene.bed.start = {core::StartKind::mixed};
    scene.bed.particles = {tube ? 1500 : 300};
    scene.bed.solids_fraction = scene.bed.start_solids_fraction = 0.4;
    const dem::Materials materials(scene);
    const core::InnerWalls walls(scene.walls, scene.column.size, false);
    double lowest = high;
    for (const dem::Particle& p : dem::start_particles(scene, materials, dem::box_of(scene))) {
      EXPECT_GE(walls.nearest(p.place.x).distance, 0.5 * bead_diameter * (1 - 2e-3));
      lowest = std::min(lowest, p.place.x[1]);
    }
    EXPECT_LT(lowest, 5e-3);
  }
}

}  // namespace
}  // namespace polybed::scenes
