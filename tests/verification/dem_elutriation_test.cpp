// Particles that a fluid carries out through an open top: what they count for on their way, and the accounts of what
// has left.
#include <numeric>

#include "core/numerics/random.hpp"
#include "measures/particle_profile.hpp"
#include "scenes/dem_scenes.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::scenes {
namespace {

/// Of a column with a fluid that flows in: particles leave at its top.
void open(core::Scene& scene, double upflow) {
  scene.column.closed = false;
  scene.column.outlet = core::Outlet::open;
  scene.column.gravity = 9.81;
  scene.inlet.superficial_velocity = {{0.0, upflow}};
}

// A sphere of 0.1 mm rises from rest in air of 1 m/s over the last 50 mm of a column of 1 m, in cells so wide that it
// stirs nothing, and takes out m g h + m v^2/2, with v of the ordinary differential equation. What it had at the start
// and the work of the fluid are that to round-off.
TEST(DemElutriation, TakesOutTheEnergyThatTheFluidGave) {
  const Sphere sphere_of_dust{1e-4, 2000, gas, 9.81, 1.0};
  core::Scene scene = wet_box(sphere_of_dust.diameter, sphere_of_dust.density, gas, {1, 1, 1}, {5, 5, 5});
  open(scene, 1.0);
  scene.column.sides = core::Boundary::periodic;
  scene.dem.fixed_step = 5e-6;
  scene.dem.fluid_every = 80;
  Beads beads(scene, {{"a", {0.51, 0.95, 0.49}}});
  const dem::Totals start = dem::totals_of(beads.model);
  beads.run_while([&] { return beads.model.particle_count() > 0; }, 100'000);
  EXPECT_EQ(beads.model.outflow()->number, std::vector<std::int64_t>{1});
  const dem::Totals end = dem::totals_of(beads.model);
  EXPECT_EQ(end.kinetic + end.potential + end.rotational + end.elastic, 0);
  const auto [v, y] = sphere_of_dust.at(beads.model.time());
  compare("height at which it left", 0.95 + y, 1 + 0.5e-4, 1e-4);  // the list is made within 5 um of that
  compare("carried out", end.carried_out, mass_of(0.5e-4, 2000) * (9.81 * (1 + 0.5e-4) + 0.5 * v * v), 1e-4);
  compare("ledger", end.sum(), start.sum(), 1e-9, end.carried_out);
  beads.steps(200);  // the fluid flows on through an empty column
  EXPECT_EQ(beads.model.coupling()->most_solids(), 0);
}

// Of a glass bead of 1 mm that rises in water the part below the top is in the cells at every step, and it rises all
// the way: its weight is carried to the end.
TEST(DemElutriation, CountsAParticleAsFarAsItIsInside) {
  constexpr double r = 0.5e-3, top = 24e-3;
  core::Scene scene = wet_box(2 * r, 2500, water, {12e-3, top, 12e-3}, {8, 16, 8});
  open(scene, 0.4);
  Beads beads(scene, {{"a", {6e-3, top - 0.8e-3, 6e-3}, {0, 0.2, 0}}});
  const double volume = measures::sphere_volume_below(r, 0, r);
  bool cut = false;
  while (beads.model.particle_count() > 0) {
    ASSERT_LT(beads.model.time(), 0.05);
    beads.steps(1);
    if (beads.model.particle_count() == 0) break;
    const double y = beads.place(0).x[1], inside = measures::sphere_volume_below(r, y, top);
    cut = cut || (inside > 0.3 * volume && inside < 0.7 * volume);
    ASSERT_NEAR(solids_of(beads.model), inside, 1e-9 * volume) << "at " << y << " m";
    ASSERT_GT(beads.motion(0).v[1], 0.1);
  }
  EXPECT_TRUE(cut);
  EXPECT_EQ(solids_of(beads.model), 0);
}

constexpr std::int64_t coarse = 16, fine = 54;

/// Fine light beads over coarse heavy ones, in water that carries the fine ones alone.
core::Scene elutriator() {
  core::Scene scene = wet_box(1.2e-3, 2500, water, {6e-3, 8e-3, 3e-3}, {3, 4, 1});
  scene.species.push_back(sphere("b", 0.2e-3, {3e5, 0.25, 1400}));
  scene.species[0].youngs_modulus = 3e5;
  open(scene, 0.05);
  scene.effects["drag"] = "cello";
  scene.effects["added_mass"] = "zuber";
  scene.dem.fluid_every = 16;
  scene.dem.greatest_speed = 0.1;
  return scene;
}

std::vector<Bead> layers() {
  std::vector<Bead> beads = cubic_lattice("a", 1.5e-3, {6e-3, 3e-3, 3e-3});
  for (Bead bead : cubic_lattice("b", 1e-3, {6e-3, 3e-3, 3e-3})) {
    bead.x[1] += 3.2e-3;
    beads.push_back(bead);
  }
  for (std::uint64_t n = 0; n < beads.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k) beads[n].x[k] += 0.2e-3 * (core::uniform(3, k, n) - 0.5);
  return beads;
}

// Every particle is in the column or counted, by species; the ledger closes to V5, with what left in it.
TEST(DemElutriation, KeepsCountAndLedger) {
  Beads beads(elutriator(), layers());
  const dem::Model& model = beads.model;
  const dem::Totals start = dem::totals_of(model);
  double greatest = 0, miss = 0;
  while (model.outflow()->number[1] < 30) {
    ASSERT_LT(model.time(), 1) << "no longer leaves";
    beads.steps(1);
    if (model.steps() % 200 != 0) continue;
    const dem::Totals now = dem::totals_of(model);
    greatest = std::max({greatest, now.kinetic + now.rotational, now.dissipated, now.elastic, std::abs(now.work)});
    miss = std::max(miss, std::abs(now.sum() - start.sum()));
    std::array<std::int64_t, 2> inside{};
    for (std::size_t i = 0; i < model.particles().owned; ++i) ++inside[std::size_t(model.particles().species[i])];
    ASSERT_EQ(inside[0] + model.outflow()->number[0], coarse);
    ASSERT_EQ(inside[1] + model.outflow()->number[1], fine);
    ASSERT_EQ(inside[0] + inside[1], model.particle_count());
  }
  EXPECT_EQ(model.outflow()->number[0], 0) << "the coarse ones stay";
  EXPECT_GT(dem::totals_of(model).carried_out, 0.01 * greatest) << "seen";
  compare("ledger of an elutriation", miss / greatest, 0, 1e-3, 1);
}

void expect_same(const core::Checkpoint& one, const core::Checkpoint& other) {
  EXPECT_EQ(one.integers, other.integers);
  EXPECT_EQ(one.numbers, other.numbers);
  ASSERT_EQ(one.arrays.size(), other.arrays.size());
  for (const auto& [name, values] : one.arrays) EXPECT_EQ(values, other.arrays.at(name)) << name;
}

// With forces that keep a memory of each particle, which goes with those that leave.
TEST(DemElutriation, ResumesWithTheSameBits) {
  core::Scene scene = elutriator();
  scene.effects["magnus"] = "rubinow_keller";
  Beads through(scene, layers()), again(scene, layers());
  const auto left = [&] { return through.model.outflow()->number[1]; };
  through.run_while([&] { return left() < 10; }, 100'000);
  through.steps(16 - through.model.steps() % 16);  // to the end of a step of the fluid
  through.model.restart();
  const core::Checkpoint middle = through.model.checkpoint();
  again.model.resume(middle);
  expect_same(again.model.checkpoint(), middle);
  for (Beads* run : {&through, &again}) run->steps(3200);
  EXPECT_GT(left(), 10);
  expect_same(again.model.checkpoint(), through.model.checkpoint());
}

TEST(DemElutriation, IsAbsentUnderAScreenAndInAFixedBed) {
  core::Scene scene = elutriator();
  EXPECT_NE(Beads(scene, layers()).model.outflow(), nullptr);
  scene.bed.held = true;
  EXPECT_EQ(Beads(scene, layers()).model.outflow(), nullptr);
  scene.bed.held = false;
  scene.column.outlet = core::Outlet::screen;
  const Beads shut(scene, layers());
  EXPECT_EQ(shut.model.outflow(), nullptr);
  EXPECT_FALSE(shut.model.checkpoint().arrays.contains("outflow"));
}

// Without a fluid the top is open to particles either way: they come back, or they are gone.
TEST(DemElutriation, ActsWithoutAFluid) {
  for (const core::Outlet outlet : {core::Outlet::screen, core::Outlet::open}) {
    core::Scene scene = dry_box(0.5e-3, {5e6, 0.25, 2500}, {0.02, 0.02, 0.02});
    scene.column.gravity = 9.81;
    scene.column.outlet = outlet;
    Beads beads(scene, {{"a", {0.01, 0.018, 0.01}, {0, 0.5, 0}}});  // 12.7 mm up
    beads.until(0.1);
    EXPECT_EQ(beads.model.particle_count(), outlet == core::Outlet::screen ? 1 : 0);
  }
}

}  // namespace
}  // namespace polybed::scenes
