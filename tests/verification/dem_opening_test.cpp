// An opening in the bottom: the rim, what falls through, and the accounts of what has left.
#include "dem/settling.hpp"
#include "scenes/dem_scenes.hpp"

namespace polybed::scenes {
namespace {

constexpr double r = 0.5e-3, youngs_modulus = 5e6, poisson_ratio = 0.25, density = 2500;

/// A box of 20 mm with an opening of 4 mm: a slot along z, periodic there, or a round hole between four walls.
core::Scene opened(bool round) {
  core::Scene scene = dry_box(r, {youngs_modulus, poisson_ratio, density}, {0.02, 0.02, 0.02});
  scene.column.dimensions = round ? 3 : 2;
  scene.dem.opening = 4e-3;
  return scene;
}

/// The force on a sphere at rest at a place, above the bottom or below it: a list of particles knows none below.
dem::Vector force_at(const core::Scene& scene, const dem::Vector& x) {
  Beads beads(scene, {{"a", {0.01, 0.01, 0.01}}});
  core::Checkpoint there = beads.model.checkpoint();
  std::copy(x.begin(), x.end(), there.arrays.at("particles").begin() + 2);  // after id and species
  beads.model.start_from(there);
  return beads.force(0);
}

// A sphere over the opening is pushed by Hertz's force along the line to the nearest point of the rim, from above, on
// its level and from below; over the plate upwards, under it downwards; amid the opening not at all.
TEST(DemOpening, PushesFromItsRim) {
  const double k = 4.0 / 3 * youngs_modulus / (1 - poisson_ratio * poisson_ratio) * std::sqrt(r), deep = 5e-6;
  const auto check = [&](const core::Scene& scene, const dem::Vector& foot, const dem::Vector& n) {
    dem::Vector x = foot;
    for (std::size_t d = 0; d < 3; ++d) x[d] += (r - deep) * n[d];
    const dem::Vector force = force_at(scene, x);
    // Places are known to 2e-18 m, 4e-13 of the overlap.
    const double allowed = 1e-10 * k * std::pow(deep, 1.5);
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_NEAR(force[d], k * std::pow(deep, 1.5) * n[d], allowed) << "along " << n[0] << " " << n[1];
  };
  for (const double up : {0.8, 0.0, -0.6}) {
    const double aside = std::sqrt(1 - up * up);
    check(opened(false), {0.012, 0, 0.003}, {-aside, up, 0});
    check(opened(false), {0.008, 0, 0.003}, {aside, up, 0});
    // 3, 4, 5 in the plane of the hole
    check(opened(true), {0.01 + 1.2e-3, 0, 0.01 - 1.6e-3}, {-0.6 * aside, up, 0.8 * aside});
  }
  for (const bool round : {false, true}) {
    check(opened(round), {0.0125, 0, 0.01}, {0, 1, 0});
    check(opened(round), {0.0125, 0, 0.01}, {0, -1, 0});
    for (const double height : {0.2e-3, 0.0, -0.2e-3})
      EXPECT_EQ(force_at(opened(round), {0.01, height, 0.01}), (dem::Vector{0, 0, 0}));
  }
}

// A bed that lay on a whole bottom: at the start of another run nothing is left of the contact with what has been
// opened, neither its force nor the springs of friction and rolling, nor what has been lost before.
TEST(DemOpening, ForgetsTheBottomThatWasThere) {
  core::Scene scene = opened(false);
  scene.column.gravity = 9.81;
  scene.effects["rolling"] = "epsd";
  scene.dem.rolling_friction = 0.2;
  core::set_friction(scene, 0.5);
  core::set_restitution(scene, 0.5);
  core::Scene shut = scene;
  shut.dem.opening.reset();
  const std::vector<Bead> bead{{"a", {0.01, r, 0.01}, {0.01, 0, 0}}};
  Beads before(shut, bead), after(scene, bead);
  before.until(0.05);
  EXPECT_EQ(before.model.walls().touching.size(), 1U);
  EXPECT_GT(dem::totals_of(before.model).dissipated, 0);
  after.model.start_from(before.model.checkpoint());
  const dem::Totals start = dem::totals_of(after.model);
  EXPECT_TRUE(after.model.walls().touching.empty());
  EXPECT_EQ(start.elastic, 0);
  EXPECT_EQ(start.dissipated, 0);
  EXPECT_EQ(after.force(0), (dem::Vector{0, 0, 0}));
  after.until(0.01);
  const dem::Totals now = dem::totals_of(after.model);
  compare("ledger after the opening", now.sum(), start.sum(), 1e-6, now.kinetic);
}

// Without loss a sphere that strikes the rim and falls through takes with it what it had at the start, m g h and
// m v^2/2. 1e-4: the integration's error of an impact of 100 steps.
TEST(DemOpening, TakesOutTheEnergyThatCameIn) {
  for (const bool round : {false, true}) {
    core::Scene scene = opened(round);
    scene.column.gravity = 9.81;
    core::set_restitution(scene, 1);
    core::set_friction(scene, 0);
    scene.dem.steps_per_contact = 100;
    Beads beads(scene, {{"a", {0.0118, 3e-3, 0.0104}, {0, -0.1, 0}}});
    const double mass = mass_of(r, density), energy = mass * (9.81 * 3e-3 + 0.5 * 0.01);
    bool struck = false;
    beads.run_while([&] {
      struck = struck || !beads.model.walls().touching.empty();
      return beads.model.particle_count() > 0;
    });
    EXPECT_TRUE(struck);
    EXPECT_EQ(beads.model.outflow()->number, std::vector<std::int64_t>{1});
    const dem::Totals now = dem::totals_of(beads.model);
    EXPECT_EQ(now.kinetic + now.potential + now.rotational + now.elastic, 0);
    compare(fmt::format("carried out, {}", round ? "hole" : "slot"), now.carried_out, energy, 1e-4);
    beads.steps(100);  // an empty box goes on
  }
}

/// 300 spheres of two sizes over the slot, falling.
core::Scene crowd() {
  core::Scene scene = opened(false);
  scene.column.size = {0.012, 0.03, 3.2e-3};
  scene.species.push_back(sphere("b", 0.7 * r, {youngs_modulus, poisson_ratio, density}));
  scene.column.gravity = 9.81;
  scene.bed.start = {core::StartKind::mixed};
  scene.bed.particles = {150, 150};
  scene.bed.start_solids_fraction = 0.5;
  scene.dem.youngs_modulus = youngs_modulus;
  scene.dem.opening = 5e-3;
  return scene;
}

// Every particle is in the box or counted, at every list, by species; the ledger closes to V5, with what left in it.
TEST(DemOpening, KeepsCountAndLedgerOfACrowd) {
  core::Timers timers;
  dem::Model model(crowd(), timers);
  const dem::Totals start = dem::totals_of(model);
  double greatest = 0, miss = 0;
  while (model.particle_count() > 100) {
    ASSERT_LT(model.time(), 1) << "no longer flows";
    model.step(1e300);
    if (model.steps() % 200 != 0) continue;
    const dem::Totals now = dem::totals_of(model);
    greatest = std::max({greatest, now.kinetic + now.rotational, now.dissipated, now.elastic});
    miss = std::max(miss, std::abs(now.sum() - start.sum()));
    std::array<std::int64_t, 2> inside{};
    for (std::size_t i = 0; i < model.particles().owned; ++i) ++inside[std::size_t(model.particles().species[i])];
    for (std::size_t j = 0; j < 2; ++j) ASSERT_EQ(inside[j] + model.outflow()->number[j], 150) << "species " << j;
    ASSERT_EQ(inside[0] + inside[1], model.particle_count());
  }
  const dem::Totals end = dem::totals_of(model);
  EXPECT_GT(std::abs(end.carried_out), 0.1 * greatest) << "seen";
  compare("ledger of an outflow", miss / greatest, 0, 1e-3, 1);
  EXPECT_LT(model.work().particle_steps, model.work().steps * 300);
  EXPECT_GT(model.work().particle_steps, model.work().steps * 100);
}

// The bottom is whole while a bed settles, and nothing leaves a scene without an opening.
TEST(DemOpening, IsShutWhileABedSettles) {
  core::Timers timers;
  core::Scene scene = crowd();
  dem::Model model(scene, timers);
  model.start_from(dem::settled(scene, model.limits().dt, nullptr));
  EXPECT_EQ(model.particle_count(), 300);
  EXPECT_EQ(model.outflow()->all(), 0);
  const auto lowest = [&] {
    double y = 1;
    for (std::size_t i = 0; i < model.particles().owned; ++i) y = std::min(y, model.particles().place[i].x[1]);
    return y;
  };
  EXPECT_GT(lowest(), 0.6 * r);
  while (model.time() < 0.02) model.step(1e300);
  EXPECT_LT(lowest(), 0) << "then it is open";
  scene.dem.opening.reset();
  EXPECT_EQ(dem::Model(scene, timers).outflow(), nullptr);
}

}  // namespace
}  // namespace polybed::scenes
