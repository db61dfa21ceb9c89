// A fixed lattice of spheres: the pressure drop is that of the drag law, -dp/dy = 18 mu u (1 - eps) f/(eps D^2).
#include "scenes/dem_scenes.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::scenes {
namespace {

constexpr double diameter = 2e-3, spacing = 2.5e-3;
constexpr dem::Vector size{20e-3, 40e-3, 10e-3};

core::Scene held_bed(const std::string& law, double velocity, const Liquid& fluid) {
  core::Scene scene = wet_box(diameter, 2500, fluid, size, {4, 8, 1});
  scene.column.closed = false;
  scene.column.sides = core::Boundary::periodic;
  scene.inlet.superficial_velocity = {{0.0, velocity}};
  scene.effects["drag"] = law;
  scene.bed.held = true;
  scene.dem.fluid_every = 4;
  scene.dem.fixed_step = 0.1 * spacing / velocity / 4;
  return scene;
}

double expected_drop(const std::string& law, double velocity, const Liquid& fluid) {
  const double eps = 1 - pi / 6 * std::pow(diameter / spacing, 3);
  return 18 * fluid.viscosity * velocity * (1 - eps) * drag_of(law, eps, diameter, velocity, fluid) /
         (eps * diameter * diameter) * size[1];
}

double drop_of(const core::Scene& scene, int fluid_steps = 30) {
  Beads bed(scene, cubic_lattice("a", spacing, size));
  bed.steps(fluid_steps * bed.model.coupling()->every());
  return bed.model.coupling()->pressure_drop();
}

// The flow is even, so the fields have no error of their own. What is left is the residual of the pressure solve, 1e-8.
constexpr double solver = 1e-6;

TEST(DemFixedBed, HasThePressureDropOfEveryLaw) {
  for (const std::string& law : closures::drag_law_names()) {
    // 20 mm/s in water: Re 40. Drag works at every law's own slip, the superficial one.
    compare(law, drop_of(held_bed(law, 0.02, water)), expected_drop(law, 0.02, water), solver);
  }
}

// From creeping flow to ten times what would lift such a bed.
TEST(DemFixedBed, HasItAtAllVelocities) {
  for (const double velocity : {1e-4, 5e-3, 0.5})
    compare(fmt::format("water {:g} m/s", velocity), drop_of(held_bed("ergun", velocity, water)),
            expected_drop("ergun", velocity, water), solver);
  for (const double velocity : {0.1, 10.0})
    compare(fmt::format("gas {:g} m/s", velocity), drop_of(held_bed("gidaspow", velocity, gas)),
            expected_drop("gidaspow", velocity, gas), solver);
}

// Walls and three dimensions: the same bed, the same drop.
TEST(DemFixedBed, DoesNotDependOnWallsAndDepth) {
  const double expected = expected_drop("ergun", 0.02, water);
  core::Scene walls = held_bed("ergun", 0.02, water);
  walls.column.sides = core::Boundary::wall;
  compare("walls", drop_of(walls), expected, solver);
  core::Scene deep = held_bed("ergun", 0.02, water);
  deep.column.dimensions = 3;
  deep.column.cells = {4, 8, 2};
  compare("3-D", drop_of(deep), expected, solver);
}

// Cells finer than the spheres, smoothed to 4 d: the gradient over the middle half of the bed, where the kernel sees no
// end: at 5 widths the Gaussian is below 1e-16 of what it is at once.
TEST(DemFixedBed, DoesNotDependOnTheCellsUnderAKernel) {
  core::Scene scene = held_bed("ergun", 0.02, water);
  scene.column.size[1] = 80e-3;
  scene.column.cells = {16, 64, 1};
  scene.dem.kernel = core::Kernel::diffusion;
  scene.dem.fixed_step = *scene.dem.fixed_step / 4;
  Beads bed(scene, cubic_lattice("a", spacing, scene.column.size));
  bed.steps(30 * bed.model.coupling()->every());
  const fluid::Flow& flow = bed.model.coupling()->flow();
  const auto p = [&](int j) { return flow.state().pressure[std::size_t(flow.grid().index(5, j))]; };
  compare("gradient", (p(24) - p(40)) / 20e-3, expected_drop("ergun", 0.02, water) / size[1], solver);
}

// The drag over a step may be a thousand times what would stop the sphere if it were free: sums hold it all the same.
TEST(DemFixedBed, TakesStepsOfAThousandRelaxationTimes) {
  constexpr double d = 20e-6, velocity = 0.02;
  core::Scene scene = held_bed("schiller_naumann", velocity, water);
  scene.species[0].diameter = d;
  const double solids = pi / 6 * std::pow(d / spacing, 3),
               f = drag_of("schiller_naumann", 1 - solids, d, velocity, water);
  scene.dem.fixed_step = 1000 * 2500 * d * d / (18 * water.viscosity * f) / 4;
  compare("drop", drop_of(scene), 18 * water.viscosity * velocity * solids * f / ((1 - solids) * d * d) * size[1],
          solver);
}

}  // namespace
}  // namespace polybed::scenes
