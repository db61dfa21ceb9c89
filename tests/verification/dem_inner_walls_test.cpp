// Walls inside the box: the force of a face on either side, edges, and a bead on a slope.
#include "dem/packing.hpp"
#include "dem/scene.hpp"
#include "scenes/dem_scenes.hpp"

namespace polybed::scenes {
namespace {

constexpr double radius = 0.5e-3;

core::Scene without_wall() { return dry_box(radius, {5e7, 0.25, 2500}, {0.04, 0.04, 0.01}); }

core::Scene with_wall(std::vector<double> from, std::vector<double> to) {
  core::Scene scene = without_wall();
  scene.walls.push_back({std::move(from), std::move(to)});
  return scene;
}

TEST(DemInnerWalls, PushAsAFaceDoesOnEitherSideAndFromTheirEdges) {
  const core::Scene scene = with_wall({0.01, 0.02}, {0.03, 0.02});
  const Beads face(without_wall(), {{"a", {0.02, radius - 5e-6, 0.005}}});
  const double expected = face.force(0)[1];
  EXPECT_GT(expected, 0);
  const auto force = [&](double x, double y) { return Beads(scene, {{"a", {x, y, 0.005}}}).force(0); };
  // A place is known to 3e-18 m, 1e-12 of the overlap.
  for (const double x : {0.011, 0.02, 0.029}) {
    const dem::Vector above = force(x, 0.02 + radius - 5e-6), below = force(x, 0.02 - radius + 5e-6);
    compare("above", above[1], expected, 1e-11);
    compare("below", below[1], -expected, 1e-11);
    EXPECT_NEAR(above[0], 0, 1e-13 * expected);  // of a place along the wall, 3e-18 m over the radius
    EXPECT_EQ(force(x, 0.02 + radius + 1e-12), (dem::Vector{0, 0, 0}));
  }
  // Beyond the edge at 0.03, in the direction (3, 4)/5 from it.
  const double away = radius - 5e-6;
  const dem::Vector edge = force(0.03 + 0.6 * away, 0.02 + 0.8 * away);
  compare("edge x", edge[0], 0.6 * expected, 1e-10);
  compare("edge y", edge[1], 0.8 * expected, 1e-10);
  EXPECT_EQ(force(0.03 + radius + 1e-12, 0.02), (dem::Vector{0, 0, 0}));
}

TEST(DemInnerWalls, AddUpWithEachOtherAndWithFaces) {
  // A slope of 45 degrees from the left face to the bottom: the bead touches it and the bottom.
  const core::Scene scene = with_wall({0, 0.01}, {0.01, 0});
  const double deep = 5e-6, x = 0.01 + std::sqrt(2.0) * (radius - deep) - (radius - deep);
  const Beads one(scene, {{"a", {x, radius - deep, 0.005}}});
  EXPECT_EQ(one.model.walls().touching.size(), 2U);
  const Beads face(without_wall(), {{"a", {0.02, radius - deep, 0.005}}});
  const double each = face.force(0)[1], half = std::sqrt(0.5);
  compare("x", one.force(0)[0], each * half, 1e-10);
  compare("y", one.force(0)[1], each * (1 + half), 1e-10);
}

// It rolls with (5/7) g sin as long as tan <= 3.5 mu, and slides beyond with g (sin - mu cos). 1e-3: as for a bead on
// the bottom of a box that leans, DemSlide.
TEST(DemInnerWalls, ABeadGoesDownASlope) {
  const double mu = 0.2, g = 9.81;
  for (const double angle : {20.0, 50.0}) {
    const double s = std::sin(angle * pi / 180), c = std::cos(angle * pi / 180), length = 0.035;
    core::Scene scene = with_wall({0.002, 0.002 + length * s}, {0.002 + length * c, 0.002});
    core::set_friction(scene, mu);
    core::set_restitution(scene, 0.5);
    scene.column.gravity = g;
    const double mass = mass_of(radius, 2500);
    // The overlap at rest, from the force of one overlap.
    const Beads pressed(without_wall(), {{"a", {0.02, radius - 1e-6, 0.005}}});
    const double sag = 1e-6 * std::pow(mass * g * c / pressed.force(0)[1], 2.0 / 3), away = radius - sag;
    const double x = 0.002 + 0.1 * length * c + away * s, y = 0.002 + 0.9 * length * s + away * c;
    Beads beads(scene, {{"a", {x, y, 0.005}}});
    const auto speed = [&] { return beads.motion(0).v[0] * c - beads.motion(0).v[1] * s; };
    beads.until(0.01);  // the spring of the contact is wound in the first 1 ms
    const double v = speed(), begin = double(beads.model.steps()) * beads.dt();
    beads.until(0.06);
    const double time = double(beads.model.steps()) * beads.dt() - begin;
    const double expected = s / c <= 3.5 * mu ? 5.0 / 7 * g * s : g * (s - mu * c);
    compare(fmt::format("slope {} a", angle), (speed() - v) / time, expected, 1e-3);
  }
}

TEST(DemInnerWalls, WhatIsPlacedAtTheStartLiesAboveThem) {
  core::Scene scene = with_wall({0, 0.02}, {0.015, 0});
  scene.bed.start = {core::StartKind::mixed};
  scene.bed.particles = {2000};
  scene.bed.solids_fraction = 0.6;
  const dem::Materials materials(scene);
  const dem::Box box = dem::box_of(scene);
  const std::vector<dem::Particle> particles = dem::start_particles(scene, materials, box);
  ASSERT_EQ(particles.size(), 2000U);
  const double top = dem::start_height(scene, materials, box);
  EXPECT_GT(top, 0.02);
  for (const dem::Particle& p : particles) {
    EXPECT_GE(p.place.x[1], 0.02 + radius * (1 - 1e-9));
    EXPECT_LE(p.place.x[1], top - radius * (1 - 1e-9));
  }
}

}  // namespace
}  // namespace polybed::scenes
