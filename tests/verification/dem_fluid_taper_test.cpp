// Particles and fluid in cones and steps: at rest, in the balance of pressure, walls and weight, fed, emptied, taken
// up.
#include <algorithm>
#include <cmath>

#include "core/numerics/metric.hpp"
#include "core/numerics/random.hpp"
#include "dem/scene.hpp"
#include "measures/particle_profile.hpp"
#include "scenes/dem_scenes.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::scenes {
namespace {

constexpr double diameter = 2e-3, across = 24e-3, high = 48e-3, spacing = 2.5e-3;
constexpr double volume = pi / 6 * diameter * diameter * diameter;

/// Diameters in m over heights in m: a cone that widens into a tube, and a tube below a step into a wider one.
const core::Taper cone{{0, 16e-3}, {32e-3, across}, {high, across}},
    step{{0, 16e-3}, {24e-3, 16e-3}, {24e-3, across}, {high, across}};

core::Scene tapered(const core::Taper& profile, double density, std::array<int, 3> cells = {6, 12, 6}) {
  core::Scene scene = wet_box(diameter, density, water, {across, high, across}, cells);
  scene.column.shape = core::ColumnShape::cylinder;
  scene.column.profile = profile;
  scene.column.gravity = 9.81;
  scene.dem.fixed_step = 1e-4;
  scene.dem.fluid_every = 10;
  return scene;
}

/// Those of a cubic lattice whose spheres lie within the walls, between two heights, moved by a share of the gaps.
std::vector<Bead> within(const core::Scene& scene, double from, double to, double moved = 0) {
  std::vector<Bead> beads;
  const dem::Box box = dem::box_of(scene);
  std::uint64_t n = 0;
  for (Bead& bead : cubic_lattice("a", spacing, {across, high, across})) {
    for (std::size_t k = 0; k < 3; ++k)
      bead.x[k] += moved * (spacing - 1.01 * diameter) * (core::uniform(3, k, n) - 0.5);
    ++n;
    if (box.within_side({bead.x, 0.5 * diameter}) && bead.x[1] > from && bead.x[1] < to) beads.push_back(bead);
  }
  return beads;
}

/// Upward force of the pressure on what is between the walls, by the open faces between layers, N: that of bottom and
/// sloping walls. Half a cell at the bottom has no face that moves: what its particles take is counted there.
double lift_of(const dem::Model& model) {
  const dem::Coupling& coupling = *model.coupling();
  const core::Grid& grid = coupling.flow().grid();
  const core::Field &p = coupling.flow().state().pressure, &open = grid.metric->open[1];
  const core::Index s = grid.stride(1);
  double force = 0;
  for (int j = 1; j < grid.cells[1]; ++j)
    for (int k = 0; k < grid.cells[2]; ++k)
      for (int i = 0; i < grid.cells[0]; ++i) {
        const auto f = std::size_t(grid.index(i, j, k));
        force += open[f] * (p[f - std::size_t(s)] - p[f]);
      }
  return force * grid.spacing[0] * grid.spacing[2];
}

double mean_speed(const dem::Model& model) {
  double sum = 0;
  for (std::size_t i = 0; i < model.particles().owned; ++i) sum += model.particles().motion[i].v[1];
  return sum / double(model.particles().owned);
}

struct Sinking {
  double lift, drop, weight, gained;  ///< N, Pa, N, N
};

/// Spheres that sink, after 0.1 s, over the next 0.05 s.
Sinking sinking(const core::Scene& scene, const std::vector<Bead>& beads) {
  Beads bed(scene, beads);
  bed.steps(1000);
  const double before = mean_speed(bed.model), excess = scene.species[0].density - water.density;
  Sinking found{0, 0, double(beads.size()) * volume * excess * 9.81, 0};
  for (int n = 0; n < 50; ++n) {
    bed.steps(10);
    found.lift += lift_of(bed.model) / 50;
    found.drop += bed.model.coupling()->pressure_drop() / 50;
  }
  // As much volume rises as sinks: spheres and fluid gain V (rho_p - rho_f) U together.
  found.gained = double(beads.size()) * volume * excess * (mean_speed(bed.model) - before) / (500 * bed.dt());
  return found;
}

std::string label(const char* what, core::Kernel kernel) { return fmt::format("{}, {}", what, core::name_of(kernel)); }

template <class Body>
void for_each_kernel(Body&& body) {
  {
    SCOPED_TRACE("bilinear");
    body(core::Kernel::bilinear, std::array<int, 3>{6, 12, 6});
  }
  SCOPED_TRACE("diffusion");
  body(core::Kernel::diffusion, std::array<int, 3>{12, 24, 12});
}

// Unevenly strewn spheres of the fluid's density: nothing moves, whatever is cut.
TEST(DemTaperedColumn, ANeutrallyBuoyantSuspensionStays) {
  for_each_kernel([](core::Kernel kernel, const std::array<int, 3>& cells) {
    for (const core::Taper& profile : {cone, step}) {
      core::Scene scene = tapered(profile, water.density, cells);
      scene.effects["added_mass"] = "zuber";
      scene.effects["drag"] = "cello";
      scene.dem.kernel = kernel;
      Beads bed(scene, within(scene, 0, high, 0.8));
      bed.steps(100);
      double most = 0;
      for (std::size_t i = 0; i < bed.model.particles().owned; ++i)
        for (const double v : bed.model.particles().motion[i].v) most = std::max(most, std::abs(v));
      compare("greatest speed after 0.01 s, m/s", most, 0, 1e-12, 1);
      compare("pressure drop", bed.model.coupling()->pressure_drop(), 0, 1e-12, water.density * 9.81 * high);
    }
  });
}

// A suspension that sinks in the tube below a step: the pressure on the bottom of the tube carries its weight.
TEST(DemTaperedColumn, TheDropBelowAStepIsTheBuoyantWeight) {
  for_each_kernel([](core::Kernel kernel, const std::array<int, 3>& cells) {
    core::Scene scene = tapered(step, 1100, cells);
    scene.effects["drag"] = "ergun";
    scene.dem.kernel = kernel;
    const Sinking found = sinking(scene, within(scene, 10e-3, 23e-3, 0.8));
    compare("drop x area over weight", found.drop * pi / 4 * 16e-3 * 16e-3 / (found.weight + found.gained), 1, 5e-3);
    compare("lift over weight", found.lift / (found.weight + found.gained), 1, 5e-3);
  });
}

// A suspension that sinks in a cone: its bottom and its wall carry the weight, by the pressure of the fluid. Particles
// give a part of their drag to faces that the wall closes, which are stairs of cells.
TEST(DemTaperedColumn, TheWallsOfAConeCarryTheBuoyantWeight) {
  for_each_kernel([](core::Kernel kernel, const std::array<int, 3>& cells) {
    core::Scene scene = tapered(cone, 1100, cells);
    scene.effects["drag"] = "ergun";
    scene.dem.kernel = kernel;
    const Sinking found = sinking(scene, within(scene, 10e-3, 46e-3, 0.8));
    compare(label("lift over weight", kernel), found.lift / (found.weight + found.gained), 1, 0.03);
  });
}

/// What the fluid does to the particles, upward, N.
double force_on(const dem::Model& model) {
  double sum = 0;
  for (std::size_t i = 0; i < model.particles().owned; ++i) {
    const dem::FluidLoad& load = model.coupling()->motion().load[i];
    sum += load.drag * (load.velocity[1] - model.particles().motion[i].v[1]) + load.force[1];
  }
  return sum;
}

/// Momentum that passes a level upwards, N.
double momentum_through(const dem::Model& model, int level) {
  const fluid::Flow& flow = model.coupling()->flow();
  const core::Grid& grid = flow.grid();
  double sum = 0;
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int i = 0; i < grid.cells[0]; ++i) {
      const auto f = std::size_t(grid.index(i, level, k));
      sum += grid.metric->open[1][f] * std::pow(flow.state().velocity[1][f], 2);
    }
  return sum * grid.spacing[0] * grid.spacing[2] * water.density;
}

// Flow through a fixed bed in a cone: bottom and wall press upwards with the force on the spheres and what the fluid
// takes away more than it brings. Spheres at the wall give a part of their drag to the faces that its stairs close.
TEST(DemTaperedColumn, TheWallsOfAConeCarryTheForceOnAFixedBed) {
  for_each_kernel([](core::Kernel kernel, const std::array<int, 3>& cells) {
    constexpr double velocity = 0.02;
    core::Scene scene = tapered(cone, 2500, cells);
    scene.column.closed = false;
    scene.column.gravity = 0;
    scene.inlet.superficial_velocity = {{0.0, velocity}};
    scene.effects["drag"] = "ergun";
    scene.bed.held = true;
    scene.dem.kernel = kernel;
    scene.dem.fluid_every = 4;
    scene.dem.fixed_step = 0.1 * high / cells[1] / velocity / 4;
    Beads bed(scene, within(scene, 8e-3, 40e-3));
    bed.steps(100 * 4);
    const double gained = momentum_through(bed.model, cells[1] - 1) - momentum_through(bed.model, 1);
    compare(label("lift over force and momentum", kernel), lift_of(bed.model) / (force_on(bed.model) + gained), 1,
            0.03);
  });
}

/// Solids in all cells, m3.
double solids_of(const dem::Model& model) {
  const dem::Coupling::Column column = model.coupling()->column();
  double sum = 0;
  for (std::size_t c = 0; c < column.fraction[0].size(); ++c)
    sum += column.grid.metric->volume[c] * column.fraction[0][c];
  return sum * column.grid.cell_volume();
}

// Spheres carried through a cone and out of its top, while others enter at its narrow bottom: what is inside is in the
// cells, and a run taken up between goes on with the same bits.
TEST(DemTaperedColumn, CountsWhatEntersAndLeavesAndResumesWithTheSameBits) {
  core::Scene scene = tapered({{0, 16e-3}, {20e-3, across}, {28e-3, across}, {high, 20e-3}}, 1010);
  scene.column.closed = false;
  scene.column.outlet = core::Outlet::open;
  scene.inlet.superficial_velocity = {{0.0, 0.12}};
  scene.effects["drag"] = "cello";
  scene.effects["added_mass"] = "zuber";
  scene.effects["magnus"] = "rubinow_keller";
  scene.feeds = {{"a", core::ColumnFace::bottom, {{0.0, 0.01}}, 0.12, {}, {}}};
  const std::vector<Bead> beads = within(scene, 24e-3, 47e-3, 0.8);
  Beads through(scene, beads), again(scene, beads);
  through.run_while([&] { return through.model.outflow()->number[0] < 20; }, 10'000);
  through.steps(10 - through.model.steps() % 10);  // to the end of a step of the fluid
  double inside = 0;
  for (std::size_t i = 0; i < through.model.particles().owned; ++i) {
    const dem::Place& place = through.model.particles().place[i];
    inside += measures::sphere_volume_below(place.radius, place.x[1], high);
  }
  compare("solids in the cells", solids_of(through.model), inside, 1e-9);
  // 10 mm/s of 201 mm2, in whole spheres of 4.19 mm3.
  const double fed = 0.01 * scene.column.cross_section() * through.model.time() / volume;
  EXPECT_NEAR(double(through.model.feeding()->all()), fed, 1);
  through.model.restart();
  const core::Checkpoint middle = through.model.checkpoint();
  again.model.resume(middle);
  for (Beads* run : {&through, &again}) run->steps(300);
  EXPECT_GT(through.model.outflow()->number[0], 20);
  const core::Checkpoint one = through.model.checkpoint(), other = again.model.checkpoint();
  EXPECT_EQ(one.integers, other.integers);
  EXPECT_EQ(one.numbers, other.numbers);
  EXPECT_EQ(one.arrays, other.arrays);
}

// A bed that has settled in a closed cone of water: nothing moves, and the water is at rest.
TEST(DemTaperedColumn, ASettledBedRests) {
  core::Scene scene = tapered(cone, 2500);
  scene.effects["drag"] = "cello";
  scene.effects["contact"] = "hertz_mindlin";
  scene.dem.youngs_modulus = 1e6;
  scene.dem.fixed_step = 2e-5;
  scene.dem.fluid_every = 16;
  core::set_restitution(scene, 0.3);
  Beads bed(scene, within(scene, 0, 16e-3, 0.8));
  bed.steps(40'000);
  const double weight = double(bed.model.particles().owned) * volume * 1500 * 9.81 / scene.column.cross_section();
  double most = 0;
  for (std::size_t i = 0; i < bed.model.particles().owned; ++i)
    for (const double v : bed.model.particles().motion[i].v) most = std::max(most, std::abs(v));
  compare("greatest speed after 0.8 s, m/s", most, 0, 1e-5, 1);
  compare("pressure drop over the weight", bed.model.coupling()->pressure_drop() / weight, 0, 3e-4, 1);
}

}  // namespace
}  // namespace polybed::scenes
