// Particles in the fluid of a round column, even or with a profile, for tests with both kernels.
#pragma once

#include <array>
#include <vector>

#include "core/numerics/metric.hpp"
#include "core/numerics/random.hpp"
#include "dem/scene.hpp"
#include "measures/particle_profile.hpp"
#include "scenes/dem_scenes.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::scenes {

/// Spheres, the column, and the spacing of their lattice, m.
constexpr double bead_diameter = 2e-3, across = 24e-3, high = 48e-3, bead_spacing = 2.5e-3;
constexpr double bead_volume = pi / 6 * bead_diameter * bead_diameter * bead_diameter;  // m3

/// Closed, without gravity. \param profile  empty: a tube
inline core::Scene round_column(double density, std::array<int, 3> cells, const core::Taper& profile = {}) {
  core::Scene scene = wet_box(bead_diameter, density, water, {across, high, across}, cells);
  scene.column.shape = core::ColumnShape::cylinder;
  scene.column.profile = profile;
  return scene;
}

/// The same with weight, in steps of 0.1 ms, ten in one of the fluid.
inline core::Scene heavy_column(double density, std::array<int, 3> cells, const core::Taper& profile = {}) {
  core::Scene scene = round_column(density, cells, profile);
  scene.column.gravity = 9.81;
  scene.dem.fixed_step = 1e-4;
  scene.dem.fluid_every = 10;
  return scene;
}

/// Those of a cubic lattice whose spheres lie within the walls, between two heights, moved by a share of the gaps.
inline std::vector<Bead> within(const core::Scene& scene, double from, double to, double moved = 0) {
  std::vector<Bead> beads;
  const dem::Box box = dem::box_of(scene);
  std::uint64_t n = 0;
  for (Bead& bead : cubic_lattice("a", bead_spacing, {across, high, across})) {
    for (std::size_t k = 0; k < 3; ++k)
      bead.x[k] += moved * (bead_spacing - 1.01 * bead_diameter) * (core::uniform(3, k, n) - 0.5);
    ++n;
    if (box.within_side({bead.x, 0.5 * bead_diameter}) && bead.x[1] > from && bead.x[1] < to) beads.push_back(bead);
  }
  return beads;
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

/// What the fluid does to the particles, upward, N.
inline double force_on(const dem::Model& model) {
  double sum = 0;
  for (std::size_t i = 0; i < model.particles().owned; ++i) {
    const dem::FluidLoad& load = model.coupling()->motion().load[i];
    sum += load.drag * (load.velocity[1] - model.particles().motion[i].v[1]) + load.force[1];
  }
  return sum;
}

/// Upward, m/s.
inline double mean_speed(const dem::Model& model) {
  double sum = 0;
  for (std::size_t i = 0; i < model.particles().owned; ++i) sum += model.particles().motion[i].v[1];
  return sum / double(model.particles().owned);
}

/// Unevenly strewn spheres of the fluid's density: nothing moves, whatever is cut.
inline void expect_a_neutral_suspension_to_stay(const core::Taper& profile) {
  for_each_kernel([&](core::Kernel kernel, const std::array<int, 3>& cells) {
    core::Scene scene = heavy_column(water.density, cells, profile);
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
  });
}

/// Spheres carried out through an open top: those inside are in the cells as far as they are inside, and what has left
/// leaves nothing behind. A run taken up between goes on with the same bits, with a force that turns the spheres. The
/// run that was not taken up is looked at by see(run) where the other begins.
template <class See>
void expect_what_leaves_to_be_gone(core::Scene scene, See&& see) {
  scene.column.closed = false;
  scene.column.outlet = core::Outlet::open;
  scene.effects["drag"] = "cello";
  scene.effects["added_mass"] = "zuber";
  scene.effects["magnus"] = "rubinow_keller";
  const std::vector<Bead> beads = within(scene, 24e-3, 47e-3, 0.8);
  Beads through(scene, beads), again(scene, beads);
  through.run_while([&] { return through.model.outflow()->number[0] < 20; }, 10'000);
  through.steps(10 - through.model.steps() % 10);  // to the end of a step of the fluid
  double inside = 0;
  for (std::size_t i = 0; i < through.model.particles().owned; ++i) {
    const dem::Place& place = through.model.particles().place[i];
    const double come =
        through.model.feeding() == nullptr
            ? 1
            : through.model.feeding()->arrivals().share(through.model.box(), place, through.model.particles().id[i]);
    inside += come * measures::sphere_volume_below(place.radius, place.x[1], high);
  }
  compare("solids in the cells", solids_of(through.model), inside, 1e-9);
  see(through);
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

}  // namespace polybed::scenes
