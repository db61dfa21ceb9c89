// Particles and fluid in cones and steps: at rest, in the balance of pressure, walls and weight, fed, emptied, taken
// up.
#include <algorithm>
#include <cmath>

#include "scenes/round_beads.hpp"

namespace polybed::scenes {
namespace {

/// Diameters in m over heights in m: a cone that widens into a tube, and a tube below a step into a wider one.
const core::Taper cone{{0, 16e-3}, {32e-3, across}, {high, across}},
    step{{0, 16e-3}, {24e-3, 16e-3}, {24e-3, across}, {high, across}};

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

struct Sinking {
  double lift, drop, weight, gained;  ///< N, Pa, N, N
};

/// Spheres that sink, after 0.1 s, over the next 0.05 s.
Sinking sinking(const core::Scene& scene, const std::vector<Bead>& beads) {
  Beads bed(scene, beads);
  bed.steps(1000);
  const double before = mean_speed(bed.model), excess = scene.species[0].density - water.density;
  Sinking found{0, 0, double(beads.size()) * bead_volume * excess * 9.81, 0};
  for (int n = 0; n < 50; ++n) {
    bed.steps(10);
    found.lift += lift_of(bed.model) / 50;
    found.drop += bed.model.coupling()->pressure_drop() / 50;
  }
  // As much volume rises as sinks: spheres and fluid gain V (rho_p - rho_f) U together.
  found.gained = double(beads.size()) * bead_volume * excess * (mean_speed(bed.model) - before) / (500 * bed.dt());
  return found;
}

std::string label(const char* what, core::Kernel kernel) { return fmt::format("{}, {}", what, core::name_of(kernel)); }

TEST(DemTaperedColumn, ANeutrallyBuoyantSuspensionStays) {
  for (const core::Taper& profile : {cone, step}) expect_a_neutral_suspension_to_stay(profile);
}

// A suspension that sinks in the tube below a step: the pressure on the bottom of the tube carries its weight.
TEST(DemTaperedColumn, TheDropBelowAStepIsTheBuoyantWeight) {
  for_each_kernel([](core::Kernel kernel, const std::array<int, 3>& cells) {
    core::Scene scene = heavy_column(1100, cells, step);
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
    core::Scene scene = heavy_column(1100, cells, cone);
    scene.effects["drag"] = "ergun";
    scene.dem.kernel = kernel;
    const Sinking found = sinking(scene, within(scene, 10e-3, 46e-3, 0.8));
    compare(label("lift over weight", kernel), found.lift / (found.weight + found.gained), 1, 0.03);
  });
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
    core::Scene scene = heavy_column(2500, cells, cone);
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

// Spheres carried through a cone and out of its top, while others enter at its narrow bottom: 10 mm/s of 201 mm2, in
// whole spheres of 4.19 mm3.
TEST(DemTaperedColumn, CountsWhatEntersAndLeavesAndResumesWithTheSameBits) {
  core::Scene scene = heavy_column(1010, {6, 12, 6}, {{0, 16e-3}, {20e-3, across}, {28e-3, across}, {high, 20e-3}});
  scene.inlet.superficial_velocity = {{0.0, 0.12}};
  scene.feeds = {{"a", core::ColumnFace::bottom, {{0.0, 0.01}}, 0.12, {}, {}}};
  expect_what_leaves_to_be_gone(scene, [&](const Beads& run) {
    const double fed = 0.01 * scene.column.cross_section() * run.model.time() / bead_volume;
    EXPECT_NEAR(double(run.model.feeding()->all()), fed, 1);
  });
}

// A bead of 1100 kg/m3 falls at some 45 mm/s: on the ledge of a step it stays, whatever rises beside it at 100 mm/s.
TEST(DemTaperedColumn, ABeadOnTheLedgeOfAStepStaysThere) {
  core::Scene scene = heavy_column(1100, {6, 12, 6}, step);
  scene.column.closed = false;
  scene.inlet.superficial_velocity = {{0.0, 0.1}};
  scene.dem.fixed_step = 2e-5;
  Beads bed(scene, {{"a", {21.1e-3, 25e-3, 12e-3}}});
  bed.steps(5000);
  EXPECT_NEAR(bed.model.particles().place[0].x[1], 25e-3, 1e-5);
}

// A bed that has settled in a closed cone of water: nothing moves, and the water is at rest.
TEST(DemTaperedColumn, ASettledBedRests) {
  core::Scene scene = heavy_column(2500, {6, 12, 6}, cone);
  scene.effects["drag"] = "cello";
  scene.effects["contact"] = "hertz_mindlin";
  scene.dem.youngs_modulus = 1e6;
  scene.dem.fixed_step = 2e-5;
  scene.dem.fluid_every = 16;
  core::set_restitution(scene, 0.3);
  Beads bed(scene, within(scene, 0, 16e-3, 0.8));
  bed.steps(40'000);
  const double weight = double(bed.model.particles().owned) * bead_volume * 1500 * 9.81 / scene.column.cross_section();
  double most = 0;
  for (std::size_t i = 0; i < bed.model.particles().owned; ++i)
    for (const double v : bed.model.particles().motion[i].v) most = std::max(most, std::abs(v));
  compare("greatest speed after 0.8 s, m/s", most, 0, 1e-5, 1);
  compare("pressure drop over the weight", bed.model.coupling()->pressure_drop() / weight, 0, 3e-4, 1);
}

}  // namespace
}  // namespace polybed::scenes
