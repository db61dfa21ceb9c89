// Particles that enter and leave through the flat sides of a column: the rim of a hole, what passing particles count
// for in a fluid, and the accounts.
#include <numeric>

#include "measures/particle_profile.hpp"
#include "scenes/side_holes.hpp"

namespace polybed::scenes {
namespace {

// Hertz's force along the line to the nearest point of what is left of the side: the rim from inside, in the plane and
// from outside, the face from inside; amid the hole none. In a corner of it the nearer edge alone pushes.
TEST(DemSidePorts, AHolePushesFromItsRim) {
  const double k = 4.0 / 3 * youngs_modulus / (1 - poisson_ratio * poisson_ratio) * std::sqrt(r), deep = 5e-6;
  const double force = k * std::pow(deep, 1.5), allowed = 1e-10 * force;  // places are known to 2e-18 m
  for (const ColumnFace at : {ColumnFace::left, ColumnFace::right, ColumnFace::front, ColumnFace::back}) {
    const auto check = [&](double foot_up, double foot_along, double out, double up, double along) {
      const double far = r - deep, outward = side_of(at) == 0 ? -1 : 1;
      const dem::Vector found =
          force_at(holed(at), beside(at, far * out, foot_up + far * up, foot_along + far * along));
      const auto across = std::size_t(axis_of(at)), beside_it = 2 - across;
      EXPECT_NEAR(found[across], force * out * outward, allowed) << name_of(at) << " " << foot_up;
      EXPECT_NEAR(found[1], force * up, allowed) << name_of(at) << " " << foot_up;
      EXPECT_NEAR(found[beside_it], force * along, allowed) << name_of(at) << " " << foot_up;
    };
    for (const double out : {-0.8, 0.0, 0.6}) {
      const double aside = std::sqrt(1 - out * out);
      check(4e-3, 10e-3, out, aside, 0);
      check(8e-3, 10e-3, out, -aside, 0);
      check(6e-3, 7e-3, out, 0, aside);
      check(6e-3, 13e-3, out, 0, -aside);
      check(4e-3, 7.51e-3, out, aside, 0);
    }
    check(3e-3, 10e-3, -1, 0, 0);
    check(6e-3, 14e-3, -1, 0, 0);
    for (const double out : {-0.2e-3, 0.0, 0.2e-3})
      EXPECT_EQ(force_at(holed(at), beside(at, out, 6e-3, 10e-3)), (dem::Vector{0, 0, 0}));
  }
}

// A hole that begins at the bottom has no rim there, one of the whole side none at all: a sphere slides out.
TEST(DemSidePorts, AHoleEndsWithItsSide) {
  for (const bool whole : {false, true}) {
    core::Scene scene = holed(ColumnFace::right);
    core::Discharge& hole = scene.discharges[0];
    if (whole)
      hole.from = hole.to = {};
    else
      hole.from[1] = 0;
    Beads beads(scene, {{"a", {width - 2e-3, r, 0.01}, {0.5, 0, 0}}});
    while (beads.model.particle_count() > 0) {
      ASSERT_LT(beads.model.time(), 0.01);
      ASSERT_TRUE(beads.model.walls().touching.empty());
      ASSERT_EQ(beads.motion(0).v, (dem::Vector{0.5, 0, 0}));
      beads.steps(1);
    }
    EXPECT_EQ(beads.model.outflow()->number, std::vector<std::int64_t>{1});
  }
}

/// Hertz's force at an overlap of 5 um, N.
double hertz() {
  return 4.0 / 3 * youngs_modulus / (1 - poisson_ratio * poisson_ratio) * std::sqrt(r) * std::pow(5e-6, 1.5);
}

// Two discharges with an edge in common are one hole: no wire pushes where they meet, its other rims do. Beyond a
// joined side the hole ends where its image does: at 17 mm and 6 mm of a bottom of 20 mm, with nothing at 0.
TEST(DemSidePorts, DischargesSideBySideAreOneHole) {
  const double near = r - 5e-6, allowed = 1e-10 * hertz();
  core::Scene scene = holed(ColumnFace::right);
  scene.discharges.push_back({ColumnFace::right, {7e-3, 8e-3}, {13e-3, 11e-3}, {{0.0, 0.1}}});
  EXPECT_EQ(force_at(scene, {width, 8e-3 - near, 10e-3}), (dem::Vector{0, 0, 0}));
  EXPECT_EQ(force_at(scene, {width, 8e-3 + near, 10e-3}), (dem::Vector{0, 0, 0}));
  EXPECT_NEAR(force_at(scene, {width, 11e-3 - near, 10e-3})[1], -hertz(), allowed);
  scene = holed(ColumnFace::bottom);
  scene.column.sides = core::Boundary::periodic;
  scene.discharges = {{ColumnFace::bottom, {0, 7e-3}, {6e-3, 13e-3}, {{0.0, 0.1}}}};
  EXPECT_NEAR(force_at(scene, {near, 0, 10e-3})[0], hertz(), allowed);
  EXPECT_NEAR(force_at(scene, {6e-3 - near, 0, 10e-3})[0], -hertz(), allowed);
  EXPECT_NEAR(force_at(scene, {width - 1e-3, near, 10e-3})[1], hertz(), allowed);
  scene.discharges.push_back({ColumnFace::bottom, {17e-3, 7e-3}, {width, 13e-3}, {{0.0, 0.1}}});
  for (const double x : {near, width - near, 0.0}) EXPECT_EQ(force_at(scene, {x, 0, 10e-3}), (dem::Vector{0, 0, 0}));
  EXPECT_NEAR(force_at(scene, {17e-3 + near, 0, 10e-3})[0], hertz(), allowed);
  EXPECT_NEAR(force_at(scene, {6e-3 - near, 0, 10e-3})[0], -hertz(), allowed);
}

// As wide as each other, and moved aside: they keep their rims, though the rules refuse them.
TEST(DemSidePorts, OnlyARectangleIsJoined) {
  core::Scene scene = holed(ColumnFace::right);
  scene.discharges = {{ColumnFace::right, {4e-3, 4e-3}, {8e-3, 8e-3}, {{0.0, 0.1}}},
                      {ColumnFace::right, {6e-3, 8e-3}, {10e-3, 12e-3}, {{0.0, 0.1}}}};
  EXPECT_EQ(Beads(scene, {{"a", {0.01, 0.01, 0.01}}}).model.box().openings.size(), 2U);
  scene.discharges[1] = {ColumnFace::right, {4e-3, 8e-3}, {8e-3, 12e-3}, {{0.0, 0.1}}};
  EXPECT_EQ(Beads(scene, {{"a", {0.01, 0.01, 0.01}}}).model.box().openings.size(), 1U);
}

// A hole that is joined of two from the middle on ends with its side all the same.
TEST(DemSidePorts, AJoinedHoleHasNoRimAtItsSide) {
  core::Scene scene = holed(ColumnFace::bottom);
  scene.column.size = {0.06, width, width};
  scene.discharges = {{ColumnFace::bottom, {28e-3, 7e-3}, {39e-3, 13e-3}, {{0.0, 0.1}}},
                      {ColumnFace::bottom, {0, 7e-3}, {28e-3, 13e-3}, {{0.0, 0.1}}}};
  EXPECT_NEAR(force_at(scene, {r - 5e-6, 0, 10e-3})[0], hertz(), 1e-10 * hertz());  // of the wall alone
}

// A chute that ends on the lower rim of a hole: beyond its end one of the two pushes.
TEST(DemSidePorts, AWallThatEndsAtARimPushesOnce) {
  core::Scene scene = holed(ColumnFace::right);
  scene.walls.push_back({{12e-3, 9e-3}, {width, 4e-3}});
  for (const double out : {0.6, 0.9}) {
    const double near = r - 5e-6;
    const dem::Vector force = force_at(scene, {width + near * out, 4e-3 + near * std::sqrt(1 - out * out), 10e-3});
    EXPECT_NEAR(std::hypot(force[0], force[1]), hertz(), 1e-10 * hertz()) << out;
  }
}

// A wall across the column that lies along the lower rim of a hole in the front.
TEST(DemSidePorts, AWallAlongARimPushesOnce) {
  core::Scene scene = holed(ColumnFace::front);
  scene.walls.push_back({{2e-3, 4e-3}, {18e-3, 4e-3}});
  EXPECT_NEAR(force_at(scene, {10e-3, 4e-3 + r - 5e-6, 0})[1], hertz(), 1e-10 * hertz());
}

// Without loss a sphere that strikes the rim on its way out takes with it what it had: m g h and m v^2/2. 1e-4: the
// integration's error of an impact of 100 steps.
TEST(DemSidePorts, TakesOutTheEnergyThatCameIn) {
  for (const auto& [at, shape] :
       {std::pair{ColumnFace::left, core::ColumnShape::box}, std::pair{ColumnFace::back, core::ColumnShape::box},
        std::pair{ColumnFace::back, core::ColumnShape::cylinder}}) {
    core::Scene scene = holed(at);
    scene.column.shape = shape;
    scene.column.gravity = 9.81;
    core::set_restitution(scene, 1);
    core::set_friction(scene, 0);
    scene.dem.steps_per_contact = 100;
    const double out = side_of(at) == 0 ? -0.4 : 0.4;
    const dem::Vector v = axis_of(at) == 0 ? dem::Vector{out, -0.1, 0} : dem::Vector{0, -0.1, out};
    Beads beads(scene, {{"a", beside(at, -3e-3, 5.5e-3, 0.0104), v}});
    bool struck = false;
    beads.run_while([&] {
      struck = struck || !beads.model.walls().touching.empty();
      return beads.model.particle_count() > 0;
    });
    EXPECT_TRUE(struck);
    const dem::Totals now = dem::totals_of(beads.model);
    EXPECT_EQ(now.kinetic + now.potential + now.rotational + now.elastic, 0);
    compare("carried out", now.carried_out, mass_of(r, density) * (9.81 * 5.5e-3 + 0.5 * 0.17), 1e-4);
    beads.steps(100);  // an empty box goes on
  }
}

// A bead that water carries out through a side: the part inside is in the cells at every step.
TEST(DemSidePorts, CountsAParticleAsFarAsItIsInside) {
  Beads beads(flushed(core::ColumnShape::box), {{"a", {6e-3, 6e-3, 11e-3}, {0, 0, 0.2}}});
  const double volume = measures::sphere_volume_below(r, 0, r);
  bool cut = false;
  while (true) {
    ASSERT_LT(beads.model.time(), 0.05);
    beads.steps(1);
    if (beads.model.particle_count() == 0) break;
    const double inside = measures::sphere_volume_below(r, beads.place(0).x[2], 12e-3);
    cut = cut || (inside > 0.3 * volume && inside < 0.7 * volume);
    ASSERT_NEAR(solids_of(beads.model), inside, 1e-9 * volume);
    ASSERT_GT(beads.motion(0).v[2], 0.1);
  }
  EXPECT_TRUE(cut);
  EXPECT_EQ(solids_of(beads.model), 0);
}

/// Two species in water that a discharge draws off; light ones are fed from the other side above the bed.
core::Scene overflowing() {
  core::Scene scene = wet_box(1.2e-3, 2500, water, {8e-3, 12e-3, 3e-3}, {4, 6, 1});
  scene.species.push_back(sphere("b", 0.4e-3, {3e5, 0.25, 1100}));
  scene.species[0].youngs_modulus = 3e5;
  scene.column.closed = false;
  scene.column.sides = core::Boundary::wall;
  scene.column.gravity = 9.81;
  scene.inlet.superficial_velocity = {{0.0, 0.03}};
  scene.effects["drag"] = "cello";
  scene.effects["added_mass"] = "zuber";
  scene.dem.fluid_every = 16;
  scene.dem.greatest_speed = 0.5;
  scene.discharges.push_back({ColumnFace::right, {3.5e-3}, {6.5e-3}, {{0.0, 0.15}}});
  scene.feeds.push_back({"b", ColumnFace::left, {{0.0, 0.01}}, 0.15, {8.5e-3}, {11.5e-3}});
  return scene;
}

std::vector<Bead> layers() {
  std::vector<Bead> beads = cubic_lattice("a", 1.5e-3, {7.5e-3, 3e-3, 3e-3});
  for (Bead bead : cubic_lattice("b", 1e-3, {8e-3, 4e-3, 3e-3})) {
    bead.x[1] += 3.2e-3;
    beads.push_back(bead);
  }
  return beads;
}

// Every particle is in the column, or came in or went and is counted, by species; the ledger closes to V5.
TEST(DemSidePorts, KeepCountAndLedger) {
  Beads beads(overflowing(), layers());
  const dem::Model& model = beads.model;
  const dem::Totals start = dem::totals_of(model);
  double greatest = 0, miss = 0;
  while (model.outflow()->number[1] < 40) {
    ASSERT_LT(model.time(), 1) << "no longer leaves";
    beads.steps(1);
    if (model.steps() % 200 != 0) continue;
    const dem::Totals now = dem::totals_of(model);
    greatest = std::max({greatest, now.kinetic + now.rotational, now.dissipated, now.elastic, std::abs(now.work)});
    miss = std::max(miss, std::abs(now.sum() - start.sum()));
    std::array<std::int64_t, 2> inside{};
    for (std::size_t i = 0; i < model.particles().owned; ++i) ++inside[std::size_t(model.particles().species[i])];
    ASSERT_EQ(inside[0] + model.outflow()->number[0], 20);
    ASSERT_EQ(inside[1] + model.outflow()->number[1], 96 + model.feeding()->number[1]);
    ASSERT_EQ(inside[0] + inside[1], model.particle_count());
  }
  EXPECT_GT(model.feeding()->all(), 5);
  compare("ledger of side ports", miss / greatest, 0, 1e-3, 1);
}

TEST(DemSidePorts, ResumeWithTheSameBits) {
  const core::Scene scene = overflowing();
  Beads through(scene, layers()), again(scene, layers());
  const auto left = [&] { return through.model.outflow()->number[1]; };
  through.run_while([&] { return left() < 10; }, 100'000);
  through.steps(16 - through.model.steps() % 16);  // to the end of a step of the fluid
  through.model.restart();
  again.model.resume(through.model.checkpoint());
  for (Beads* run : {&through, &again}) run->steps(3200);
  EXPECT_GT(left(), 10);
  expect_same_bits(through, again);
}

// By hand: 10 mm/s of 6 by 4 mm for 20 ms are 4.8 mm3, 9 spheres of 0.5236 mm3. They enter within the port at the given
// velocity, and bring m v^2/2 each.
TEST(DemSidePorts, AFeedEntersThroughItsPort) {
  for (const ColumnFace at : {ColumnFace::left, ColumnFace::right, ColumnFace::front, ColumnFace::back}) {
    core::Scene scene = dry_box(r, {youngs_modulus, poisson_ratio, density}, {width, width, width});
    scene.feeds.push_back({"a", at, {{0.0, 0.01}}, 0.5, {7e-3, 4e-3}, {13e-3, 8e-3}});
    Beads beads(scene, {{"a", {0.01, 0.019, 0.01}}});
    beads.until(0.02);
    const dem::Particles& particles = beads.model.particles();
    const auto across = std::size_t(axis_of(at)), along = 2 - across;
    ASSERT_EQ(beads.model.feeding()->number, std::vector<std::int64_t>{9});
    for (std::size_t i = 0; i < particles.owned; ++i) {
      if (particles.id[i] == 0) continue;
      const dem::Vector& x = particles.place[i].x;
      EXPECT_EQ(particles.motion[i].v[across], side_of(at) == 0 ? 0.5 : -0.5);
      EXPECT_TRUE(x[1] >= 4e-3 + r && x[1] <= 8e-3 - r && x[along] >= 7e-3 + r && x[along] <= 13e-3 - r);
    }
    compare("carried in", dem::totals_of(beads.model).carried_in, 9 * mass_of(r, density) * 0.125, 1e-9);
  }
}

// Two faces whose feeds share a corner and call in the same steps. What enters overlaps nothing, but for what it moves
// in its first step.
TEST(DemSidePorts, FeedsInACornerLeaveEachOtherRoom) {
  core::Scene scene = dry_box(r, {youngs_modulus, poisson_ratio, density}, {width, width, width});
  scene.feeds.push_back({"a", ColumnFace::left, {{0.0, 0.1}}, 0.5, {0, 0}, {width, 2e-3}});
  scene.feeds.push_back({"a", ColumnFace::bottom, {{0.0, 0.1}}, 0.5, {0, 0}, {2e-3, width}});
  Beads beads(scene, {{"a", {0.01, 0.019, 0.01}}});
  const dem::Particles& particles = beads.model.particles();
  const double step = 0.5 * beads.model.limits().dt;
  std::int64_t before = 1;
  while (beads.model.time() < 0.02) {
    beads.steps(1);
    for (std::size_t i = 0; i < particles.owned; ++i)
      for (std::size_t j = 0; particles.id[i] >= before && j < particles.owned; ++j) {
        if (i == j) continue;
        const dem::Vector &a = particles.place[i].x, &b = particles.place[j].x;
        ASSERT_GE(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), 2 * r - 3 * step);
      }
    before = 1 + beads.model.feeding()->all();
  }
  EXPECT_GT(before, 50);
}

TEST(DemSidePorts, AreAbsentFromAFixedBedAndAWholeBox) {
  core::Scene scene = overflowing();
  scene.feeds.clear();
  EXPECT_NE(Beads(scene, layers()).model.outflow(), nullptr);
  scene.bed.held = true;
  EXPECT_EQ(Beads(scene, layers()).model.outflow(), nullptr);
  scene.discharges.clear();
  EXPECT_TRUE(Beads(scene, layers()).model.box().plain());
}

}  // namespace
}  // namespace polybed::scenes
