// How far neighbours have moved relative to each other, by hand, and that a list kept for it misses no contact.
#include "dem/contacts/relative_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "core/timers.hpp"
#include "dem/model.hpp"

namespace polybed::dem {
namespace {

/// Blocks of 2.5, because two radii, the reach and twice a radius are 2.1. \param joined  its sides, along x
Box ten_blocks(bool joined) {
  Box box;
  box.size = {25, 2.5, 2.5};
  box.periodic = {joined, false, false};
  return box;
}

/// Bound after particles at x have moved along x and y.
RelativeMotion::Moved moved(bool joined, const std::vector<double>& x, const std::vector<std::array<double, 2>>& by) {
  const Box box = ten_blocks(joined);
  RelativeMotion motion(box, 1, 0.1, x.size());
  Particles particles;
  for (std::size_t i = 0; i < x.size(); ++i) {
    Particle p{};
    p.id = std::int64_t(i);
    p.place = {{x[i], 1, 1}, 0.5};
    particles.add(p);
  }
  particles.owned = x.size();
  motion.mark(particles);
  for (std::size_t i = 0; i < x.size(); ++i) {
    particles.place[i].x[0] += by[i][0];
    particles.place[i].x[1] += by[i][1];
  }
  return motion.since(particles, nullptr);
}

constexpr double round_off = 1e-14;  // of places up to 40

TEST(RelativeMotion, CountsWhatNeighboursMoveApart) {
  const auto [together, most] = moved(false, {1, 2, 4}, {{0.3, 0.4}, {0.3, 0.4}, {0.3, 0.4}});
  EXPECT_NEAR(together, 0, round_off);
  EXPECT_DOUBLE_EQ(most, 0.5);  // 3, 4, 5
  // In adjacent blocks: apart by 0.3 along x and 0.4 along y.
  EXPECT_DOUBLE_EQ(moved(false, {1, 4}, {{0.1, 0}, {-0.2, 0.4}}).apart, 0.5);
  // In one block. The displacements of all that is in it count, also of pairs that move along different axes.
  EXPECT_DOUBLE_EQ(moved(false, {1, 1.5, 2}, {{0.3, 0}, {0, 0.4}, {0, 0}}).apart, 0.5);
}

TEST(RelativeMotion, LeavesOutParticlesThatAreFarFromEachOther) {
  EXPECT_EQ(moved(false, {1, 6}, {{0.3, 0}, {-0.3, 0}}).apart, 0);   // a block lies between them
  EXPECT_EQ(moved(false, {1, 24}, {{0.3, 0}, {-0.3, 0}}).apart, 0);  // at both ends
  EXPECT_NEAR(moved(true, {1, 24}, {{0.3, 0}, {-0.3, 0}}).apart, 0.6, round_off);
  // Beyond an end: they count to the last block.
  EXPECT_NEAR(moved(false, {-40, 30, 24}, {{0, 0}, {0.2, 0}, {0, 0}}).apart, 0.2, round_off);
}

TEST(RelativeMotion, ReportsThatAPlaceIsNoNumber) {
  EXPECT_TRUE(std::isnan(moved(false, {1, 2}, {{std::nan(""), 0}, {0, 0}}).most));
  EXPECT_TRUE(std::isnan(moved(false, {1, 2}, {{0, 0}, {0, std::nan("")}}).most));
}

/// Spheres of 1 mm between a bottom and a top, which turn around the middle and stream through the joined sides.
core::Scene streaming() {
  core::Scene scene;
  core::Species sphere;
  sphere.name = "a";
  sphere.diameter = 1e-3;
  sphere.density = 2500;
  scene.species = {sphere};
  scene.column.size = {12e-3, 12e-3, 3.3e-3};
  scene.column.cells = {6, 6, 1};
  scene.column.gravity = 0;
  scene.column.sides = core::Boundary::periodic;
  scene.bed.start = {core::StartKind::mixed};
  scene.bed.particles = {250};
  scene.bed.solids_fraction = 0.6;
  scene.bed.start_solids_fraction = 0.35;
  scene.effects["contact"] = "hertz";
  scene.dem.youngs_modulus = 5e6;
  scene.dem.greatest_speed = 0.5;
  scene.dem.max_overlap = 0.1;
  scene.fluid.name = "none";
  return scene;
}

TEST(RelativeMotion, KeepsAListThatMissesNoContact) {
  core::Timers timers;
  Model model(streaming(), timers);
  std::vector<Kick> kicks(model.particles().size());
  for (std::size_t i = 0; i < kicks.size(); ++i) {
    const Vector& x = model.particles().place[i].x;
    kicks[std::size_t(model.particles().id[i])].dv = {0.3 - 10 * (x[1] - 6e-3), 10 * (x[0] - 6e-3), 0};
  }
  model.kick(kicks);
  double travelled = 0;
  std::size_t contacts = 0;
  for (int step = 0; step < 1500; ++step) {
    model.step(1e9);
    const Particles& particles = model.particles();
    double fastest = 0;
    for (const Motion& m : particles.motion) fastest = std::max(fastest, std::hypot(m.v[0], m.v[1], m.v[2]));
    travelled += fastest * model.limits().dt;
    std::set<std::pair<int, int>> listed, beside_wall;
    for (const Contacts::Pair& p : model.pairs().pairs) listed.insert(std::minmax(p.first, p.second));
    for (const Contacts::Pair& p : model.walls().pairs) beside_wall.insert({p.first, p.second});
    const Images images = model.images();
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Place& here = particles.place[i];
      for (std::size_t j = i + 1; j < particles.size(); ++j) {
        const Place& there = particles.place[j];
        const Vector d{here.x[0] - there.x[0], here.x[1] - there.x[1], here.x[2] - there.x[2]};
        const Vector seen = images.seen(d, images.nearest(d));
        if (std::hypot(seen[0], seen[1], seen[2]) >= here.radius + there.radius) continue;
        ++contacts;
        EXPECT_TRUE(listed.contains({int(i), int(j)})) << "step " << step;
      }
      for (std::size_t w = 0; w < model.box().walls.size(); ++w) {
        const Wall& wall = model.box().walls[w];
        if (std::abs(here.x[std::size_t(wall.axis)] - wall.place) >= here.radius) continue;
        ++contacts;
        EXPECT_TRUE(beside_wall.contains({int(i), int(w)})) << "step " << step;
      }
    }
  }
  EXPECT_GT(contacts, 1000u);
  // A list that ended with the farthest particle would have lasted until it had moved by half of the skin.
  EXPECT_LT(double(model.work().rebuilds), 0.5 * travelled / (0.5 * 0.1e-3));
}

}  // namespace
}  // namespace polybed::dem
