// Particles and fluid in a round column, without friction of the fluid on its wall: forces balance over the circle.
#include <algorithm>
#include <cmath>

#include "core/numerics/metric.hpp"
#include "core/numerics/random.hpp"
#include "measures/particle_profile.hpp"
#include "scenes/dem_scenes.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::scenes {
namespace {

constexpr double diameter = 2e-3, across = 24e-3, high = 48e-3, spacing = 2.5e-3;
constexpr double area = pi / 4 * across * across;

core::Scene round_column(double density, std::array<int, 3> cells) {
  core::Scene scene = wet_box(diameter, density, water, {across, high, across}, cells);
  scene.column.shape = core::ColumnShape::cylinder;
  return scene;
}

/// Those of a cubic lattice whose spheres lie within the circle, between two heights, moved by a share of the gaps.
std::vector<Bead> within(double from, double to, double moved = 0) {
  std::vector<Bead> beads;
  std::uint64_t n = 0;
  for (Bead& bead : cubic_lattice("a", spacing, {across, high, across})) {
    for (std::size_t k = 0; k < 3; ++k)
      bead.x[k] += moved * (spacing - 1.01 * diameter) * (core::uniform(3, k, n) - 0.5);
    ++n;
    const double away = std::hypot(bead.x[0] - 0.5 * across, bead.x[2] - 0.5 * across);
    if (away < 0.5 * (across - diameter) && bead.x[1] > from && bead.x[1] < to) beads.push_back(bead);
  }
  return beads;
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

/// Kernels of both kinds, cells wider and narrower than the spheres.
template <class Body>
void for_each_kernel(Body&& body) {
  {
    SCOPED_TRACE("bilinear");
    body(core::Kernel::bilinear, std::array<int, 3>{6, 12, 6});
  }
  SCOPED_TRACE("diffusion");
  body(core::Kernel::diffusion, std::array<int, 3>{12, 24, 12});
}

// A fixed bed between clear fluid above and below. The fluid loses momentum to the spheres alone; what it carries out
// through the top more than in through the bottom is counted.
TEST(DemRoundColumn, TheDropOverAFixedBedIsTheForceOnIt) {
  for_each_kernel([](core::Kernel kernel, const std::array<int, 3>& cells) {
    constexpr double velocity = 0.02;
    core::Scene scene = round_column(2500, cells);
    scene.column.closed = false;
    scene.inlet.superficial_velocity = {{0.0, velocity}};
    scene.effects["drag"] = "ergun";
    scene.bed.held = true;
    scene.dem.kernel = kernel;
    scene.dem.fluid_every = 4;
    scene.dem.fixed_step = 0.1 * high / cells[1] / velocity / 4;
    Beads bed(scene, within(12e-3, 36e-3));
    bed.steps(200 * 4);
    const fluid::Flow& flow = bed.model.coupling()->flow();
    const core::Grid& grid = flow.grid();
    double out = 0;
    for (int k = 0; k < cells[2]; ++k)
      for (int i = 0; i < cells[0]; ++i) {
        const auto f = std::size_t(grid.index(i, cells[1], k));
        const double u = flow.state().velocity[1][f];
        out +=
            grid.metric->open[1][f] * grid.spacing[0] * grid.spacing[2] * water.density * (u * u - velocity * velocity);
      }
    const double force = force_on(bed.model);
    // The flow above the bed is not quite steady after so long.
    compare("drop x area", bed.model.coupling()->pressure_drop() * area, force + out, 1e-3);
    EXPECT_LT(std::abs(out), 0.05 * force);
  });
}

// Spheres that sink in a closed column: once the mean speed is steady the fluid's pressure on the bottom carries their
// weight. As the volume flux over each layer is 0, the momentum of the fluid goes with theirs.
TEST(DemRoundColumn, TheDropUnderASuspensionIsItsBuoyantWeight) {
  for_each_kernel([](core::Kernel kernel, const std::array<int, 3>& cells) {
    constexpr double density = 1100;
    core::Scene scene = round_column(density, cells);
    scene.column.gravity = 9.81;
    scene.effects["drag"] = "ergun";
    scene.dem.kernel = kernel;
    scene.dem.fixed_step = 1e-4;
    scene.dem.fluid_every = 10;
    const std::vector<Bead> beads = within(16e-3, 46e-3, 0.8);
    Beads bed(scene, beads);
    const double weight = double(beads.size()) * pi / 6 * std::pow(diameter, 3) * (density - water.density) * 9.81;
    const auto speed = [&] {
      double sum = 0;
      for (std::size_t i = 0; i < beads.size(); ++i) sum += bed.model.particles().motion[i].v[1];
      return sum / double(beads.size());
    };
    bed.steps(1000);
    const double before = speed(), solids = double(beads.size()) * pi / 6 * std::pow(diameter, 3);
    double drop = 0;
    for (int n = 0; n < 50; ++n) {
      bed.steps(10);
      drop += bed.model.coupling()->pressure_drop() / 50;
    }
    // Momentum that spheres and fluid have gained together: V (rho_p - rho_f) U.
    const double gained = solids * (density - water.density) * (speed() - before) / (500 * bed.dt());
    compare("drop x area over weight", drop * area / (weight + gained), 1, 1e-3);
    EXPECT_LT(speed(), -1e-3);
    EXPECT_LT(std::abs(gained), 0.05 * weight);
  });
}

// Unevenly strewn spheres of the fluid's density: nothing moves, whatever is cut.
TEST(DemRoundColumn, ANeutrallyBuoyantSuspensionStays) {
  for_each_kernel([](core::Kernel kernel, const std::array<int, 3>& cells) {
    core::Scene scene = round_column(water.density, cells);
    scene.column.gravity = 9.81;
    scene.effects["added_mass"] = "zuber";
    scene.effects["drag"] = "cello";
    scene.dem.kernel = kernel;
    scene.dem.fixed_step = 1e-4;
    scene.dem.fluid_every = 10;
    Beads bed(scene, within(0, high, 0.8));
    bed.steps(100);
    double most = 0;
    for (std::size_t i = 0; i < bed.model.particles().owned; ++i)
      for (const double v : bed.model.particles().motion[i].v) most = std::max(most, std::abs(v));
    compare("greatest speed after 0.01 s, m/s", most, 0, 1e-12, 1);
    compare("pressure drop", bed.model.coupling()->pressure_drop(), 0, 1e-12, water.density * 9.81 * high);
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

// Spheres carried out through an open top: those inside are in the cells as far as they are inside, and what has left
// leaves nothing behind. A run taken up between goes on with the same bits, with a force that turns the spheres.
TEST(DemRoundColumn, LosesWhatPassesItsTopAndResumesWithTheSameBits) {
  core::Scene scene = round_column(1010, {6, 12, 6});
  scene.column.closed = false;
  scene.column.outlet = core::Outlet::open;
  scene.column.gravity = 9.81;
  scene.inlet.superficial_velocity = {{0.0, 0.06}};
  scene.effects["drag"] = "cello";
  scene.effects["added_mass"] = "zuber";
  scene.effects["magnus"] = "rubinow_keller";
  scene.dem.fixed_step = 1e-4;
  scene.dem.fluid_every = 10;
  const std::vector<Bead> beads = within(24e-3, 47e-3, 0.8);
  Beads through(scene, beads), again(scene, beads);
  through.run_while([&] { return through.model.outflow()->number[0] < 20; }, 10'000);
  through.steps(10 - through.model.steps() % 10);  // to the end of a step of the fluid
  double inside = 0;
  for (std::size_t i = 0; i < through.model.particles().owned; ++i) {
    const dem::Place& place = through.model.particles().place[i];
    inside += measures::sphere_volume_below(place.radius, place.x[1], high);
  }
  compare("solids in the cells", solids_of(through.model), inside, 1e-9);
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

// Water that rises slowly, fed with glass from the top, anywhere in the circle: 1 mm/s of 452 mm2 for 0.1 s, in whole
// spheres of 4.19 mm3. What has come in is in the cells.
TEST(DemRoundColumn, IsFedWithinItsCircle) {
  core::Scene scene = round_column(2500, {6, 12, 6});
  scene.column.closed = false;
  scene.column.gravity = 9.81;
  scene.inlet.superficial_velocity = {{0.0, 0.01}};
  scene.dem.fixed_step = 1e-4;
  scene.dem.fluid_every = 10;
  scene.feeds = {{"a", core::ColumnFace::top, {{0.0, 1e-3}}, 0.1, {}, {}}};
  Beads bed(scene, {{"a", {0.5 * across, 10e-3, 0.5 * across}}});
  bed.steps(1000);
  EXPECT_EQ(bed.model.feeding()->all(), 10);
  compare("solids in the cells", solids_of(bed.model), 11 * pi / 6 * std::pow(diameter, 3), 1e-9);
}

}  // namespace
}  // namespace polybed::scenes
