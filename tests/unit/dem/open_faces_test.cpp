// What a particle that passes an open top or a hole in a side counts for the fluid, against values by hand.
#include "dem/coupling/open_faces.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "cloud.hpp"
#include "dem/coupling/scatter.hpp"
#include "dem/scene.hpp"

namespace polybed::dem::test {
namespace {

constexpr double height = 10e-3, cell = 2e-3, r = 0.55e-3;  ///< of the cloud's column, in three dimensions; coarse
constexpr std::int32_t coarse = 1;

struct ToFluid {
  fluid::ParticlePhase phase;
  std::vector<core::Field> fraction;
};

Box open_top() {
  core::Scene scene = cloud_scene(3, false);
  scene.column.outlet = core::Outlet::open;
  scene.column.closed = false;
  return box_of(scene);
}

ToFluid give(const Cloud& cloud, bool open) {
  Scatter scatter(cloud.grid, cloud.grid, cloud.materials, false, cloud.volume, 0.2);
  if (open) scatter.open(open_top());
  ToFluid given{fluid::ParticlePhase(cloud.grid, false), {core::make_field(cloud.grid), core::make_field(cloud.grid)}};
  scatter.collect(cloud.particles, cloud.loads, 1e-3);
  scatter.give(nullptr, nullptr, true, given.phase, given.fraction);
  return given;
}

/// A coarse sphere over the middle of cells, its centre so far above the top, m, rising at 0.1 m/s.
Cloud sphere_at(double above) {
  Cloud cloud(cloud_scene(3, false));
  cloud.add(coarse, {5e-3, height + above, 5e-3}, {0, 0.1, 0});
  return cloud;
}

double sum(const core::Field& field) { return std::accumulate(field.begin(), field.end(), 0.0); }

// A cap of height h has the volume pi h^2 (3 r - h)/3: with h = r/2 that is 5/32 of the sphere.
TEST(OpenFaces, LeavesTheShareOfASphericalCap) {
  const OpenFaces top(core::grid_of(cloud_scene(3, false).column, nullptr), open_top());
  const auto share = [&](double above) { return top.inside({{5e-3, height + above, 5e-3}, r}, 0); };
  EXPECT_NEAR(share(-2 * r), 1, 1e-14);
  EXPECT_NEAR(share(-r), 1, 1e-12);
  EXPECT_NEAR(share(-0.5 * r), 27.0 / 32, 1e-12);
  EXPECT_NEAR(share(0), 0.5, 1e-12);
  EXPECT_NEAR(share(0.5 * r), 5.0 / 32, 1e-12);
  EXPECT_EQ(share(1.001 * r), 0);
  EXPECT_FALSE(top.cuts({{5e-3, height - 1.001 * r, 5e-3}, r}, 0));
  EXPECT_TRUE(top.cuts({{5e-3, height - 0.999 * r, 5e-3}, r}, 0));
}

// Of the particles that come in the last ones count in part.
TEST(OpenFaces, CountWhatComesInAsItsArrivalSays) {
  OpenFaces top(core::grid_of(cloud_scene(3, false).column, nullptr), open_top());
  const Place low{{5e-3, r, 5e-3}, r}, half{{0.1 * r, height, 5e-3}, r}, on{{5e-3, 2 * r, 5e-3}, r};
  const double way = 0.5 * r;  // a cap of 5/32
  top.see({.first = 7, .of = {{way, core::ColumnFace::bottom}, {r, core::ColumnFace::left}}});
  EXPECT_FALSE(top.cuts(low, 6));
  EXPECT_EQ(top.inside(low, 6), 1);
  EXPECT_TRUE(top.cuts(low, 7));
  EXPECT_NEAR(top.inside(low, 7), 5.0 / 32, 1e-12);
  EXPECT_NEAR(top.inside(on, 7), 0.5, 1e-12);  // moved on by a radius
  EXPECT_NEAR(top.inside(half, 8), 0.25, 1e-12);
  top.see({});
  EXPECT_FALSE(top.cuts(low, 7));
}

// Half a radius above the top: 5/32 of the sphere are in the uppermost cell. On the face, which stands for half a cell,
// the weight is 1 - 0.275/2, twice.
TEST(OpenFaces, GivesTheFluidTheShareInside) {
  Cloud cloud = sphere_at(0.5 * r);
  FluidLoad& f = cloud.loads[0];
  const double mass = 1 / cloud.particles.motion[0].inverse_mass, psi = cloud.grid.cell_volume();
  f.drag = 700 * mass;  // kappa dt = 0.7
  f.impulse = {0, 0.01 * mass, 0};
  const double share = 5.0 / 32, v = cloud.volume, weight = 2 * (1 - 0.25 * r / (0.5 * cell)), g = 1 - std::exp(-0.7);
  const ToFluid given = give(cloud, true);
  const auto top_cell = std::size_t(cloud.grid.index(2, 4, 2)), face = std::size_t(cloud.grid.index(2, 5, 2));
  EXPECT_NEAR(given.fraction[coarse][top_cell] * psi, share * v, 1e-12 * v);
  EXPECT_NEAR(sum(given.fraction[coarse]) * psi, share * v, 1e-12 * v);
  EXPECT_NEAR((1 - given.phase.voidage_on[1][face]) * psi, weight * share * v, 1e-9 * v);
  EXPECT_NEAR(given.phase.flux[1][face] * psi, weight * share * v * 0.1, 1e-12 * v);
  EXPECT_NEAR(given.phase.impulse[1][face] * psi, weight * share * 0.01 * mass, 1e-12 * mass);
  EXPECT_NEAR(given.phase.drag[1][face] * psi, weight * share * mass * g, 1e-12 * mass);
  EXPECT_NEAR(given.phase.follow[1][face] * psi, weight * share * v * g, 1e-12 * v);
}

// Over the passage of a particle the flux through the top adds up to its volume, and what is in the cells falls from
// all of it to nothing without a jump. Midpoints on both sides of the top: the sum has no error but round-off.
TEST(OpenFaces, TakesTheVolumeOfAParticleThroughTheTop) {
  constexpr int steps = 150;  // on either side, to 3 mm
  constexpr double step = cell / 100;
  double through = 0, before = 1;
  for (int n = -steps; n < steps; ++n) {
    const Cloud cloud = sphere_at((n + 0.5) * step);
    const ToFluid given = give(cloud, true);
    const double psi = cloud.grid.cell_volume();
    const double inside = sum(given.fraction[coarse]) * psi / cloud.volume;
    EXPECT_LE(inside, before + 1e-12);
    EXPECT_LE(before - inside, 0.75 * step / r + 1e-12) << "the greatest slope is 3/(4 r)";
    before = inside;
    // F A dt over V, with dt = step/0.1 and A = psi/cell
    through += given.phase.flux[1][std::size_t(cloud.grid.index(2, 5, 2))] * psi / cell * step / 0.1 / cloud.volume;
  }
  EXPECT_EQ(before, 0);
  EXPECT_NEAR(through, 1, 1e-11);
}

// A hole from 4 to 8 mm of the left side: in line with it, and beyond the side, the part inside counts; what is pressed
// into the wall beside it counts whole. By hand: caps as above.
TEST(OpenFaces, CutAtAHoleInASide) {
  core::Scene scene = cloud_scene(3, false);
  scene.column.closed = false;
  scene.discharges.push_back({core::ColumnFace::left, {0, 4e-3}, {scene.column.size[2], 8e-3}, {{0.0, 0.1}}});
  const OpenFaces side(core::grid_of(scene.column, nullptr), box_of(scene));
  const auto at = [](double x, double y) { return Place{{x, y, 5e-3}, r}; };
  EXPECT_FALSE(side.cuts(at(1.001 * r, 6e-3), 0));
  EXPECT_FALSE(side.cuts(at(0.99 * r, 3.9e-3), 0));
  EXPECT_FALSE(side.cuts(at(0.99 * r, 8.1e-3), 0));
  EXPECT_EQ(side.inside(at(0.99 * r, 3.9e-3), 0), 1);
  EXPECT_NEAR(side.inside(at(0.5 * r, 6e-3), 0), 27.0 / 32, 1e-12);
  EXPECT_NEAR(side.inside(at(0, 4.1e-3), 0), 0.5, 1e-12);
  EXPECT_NEAR(side.inside(at(-0.5 * r, 3.9e-3), 0), 5.0 / 32, 1e-12);
  EXPECT_EQ(side.on_faces(at(-0.5 * r, 6e-3)), 1);
}

// Particles that do not reach the top count as in a column that is shut, to the bit.
TEST(OpenFaces, ChangesNothingBelowIt) {
  Cloud cloud(cloud_scene(3, false), 200);
  for (Place& place : cloud.particles.place) place.x[1] *= 0.9;
  const ToFluid open = give(cloud, true), shut = give(cloud, false);
  EXPECT_EQ(open.fraction, shut.fraction);
  EXPECT_EQ(open.phase.voidage_on, shut.phase.voidage_on);
  EXPECT_EQ(open.phase.flux, shut.phase.flux);
  EXPECT_EQ(open.phase.impulse, shut.phase.impulse);
  EXPECT_EQ(open.phase.drag, shut.phase.drag);
  EXPECT_EQ(open.phase.yield, shut.phase.yield);
}

}  // namespace
}  // namespace polybed::dem::test
