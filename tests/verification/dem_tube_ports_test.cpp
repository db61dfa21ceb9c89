// Particles that enter and leave through the curved side of a tube.
#include "core/case/grading.hpp"
#include "measures/particle_profile.hpp"
#include "scenes/side_holes.hpp"

namespace polybed::scenes {
namespace {

/// A round box of 20 mm with a hole in a side, as in holed(): it spans the angles of 7 and 13 mm across.
core::Scene holed_tube(ColumnFace at) {
  core::Scene scene = holed(at);
  scene.column.shape = core::ColumnShape::cylinder;
  return scene;
}

// Hertz's force, with the side's curvature, along the line to the nearest point of what is left of the curved side.
// Around the axis the hole spans asin(0.3) on either side.
TEST(DemSidePorts, AHoleInATubePushesFromItsRim) {
  constexpr double deep = 5e-6, far = r - deep, radius = 0.5 * width;
  const double force = 4.0 / 3 * youngs_modulus / (1 - poisson_ratio * poisson_ratio) *
                       std::sqrt(r / std::sqrt(1 - r / radius)) * std::pow(deep, 1.5);
  for (const ColumnFace at : {ColumnFace::left, ColumnFace::right, ColumnFace::front, ColumnFace::back}) {
    const double outward = side_of(at) == 0 ? -1 : 1;
    const auto across = std::size_t(axis_of(at)), along = 2 - across;
    const auto check = [&](double angle, double height, double out, double up, double aside) {
      dem::Vector x{}, n{};
      n[across] = outward * (out * std::cos(angle) - aside * std::sin(angle));
      n[along] = out * std::sin(angle) + aside * std::cos(angle);
      n[1] = up;
      x[across] = radius + outward * radius * std::cos(angle);
      x[along] = radius + radius * std::sin(angle);
      x[1] = height;
      const dem::Vector found = force_at(holed_tube(at), {x[0] + far * n[0], x[1] + far * n[1], x[2] + far * n[2]});
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k], force * n[k], 1e-9 * force) << name_of(at) << k;
    };
    const double edge = std::asin(0.3);
    for (const double out : {-0.6, -0.2}) {
      const double beside = std::sqrt(1 - out * out);
      check(0.1, 4e-3, out, beside, 0);
      check(-0.2, 8e-3, out, -beside, 0);
      check(edge, 6e-3, out, 0, -beside);
      check(-edge, 6e-3, out, 0, beside);
    }
    check(0, 3e-3, -1, 0, 0);
    check(0.6, 6e-3, -1, 0, 0);
    for (const double out : {-0.2e-3, 0.0, 0.2e-3})
      EXPECT_EQ(force_at(holed_tube(at), beside(at, out, 6e-3, 10e-3)), (dem::Vector{0, 0, 0}));
  }
}

// As through a flat side. They enter at the curved wall, and do not touch it.
TEST(DemSidePorts, AFeedEntersATubeThroughItsPort) {
  for (const ColumnFace at : {ColumnFace::left, ColumnFace::right, ColumnFace::front, ColumnFace::back}) {
    core::Scene scene = dry_box(r, {youngs_modulus, poisson_ratio, density}, {width, width, width});
    scene.column.shape = core::ColumnShape::cylinder;
    scene.feeds.push_back({"a", at, {{0.0, 0.01}}, 0.5, {4e-3, 4e-3}, {10e-3, 8e-3}});
    Beads beads(scene, {{"a", {0.01, 0.019, 0.01}}});
    const auto across = std::size_t(axis_of(at)), along = 2 - across;
    std::int64_t seen = 1;
    while (beads.model.time() < 0.02) {
      beads.steps(1);
      const dem::Particles& particles = beads.model.particles();
      for (std::size_t i = 0; i < particles.owned; ++i) {
        if (particles.id[i] < seen) continue;
        const dem::Vector& x = particles.place[i].x;
        EXPECT_NEAR(std::hypot(x[0] - 0.5 * width, x[2] - 0.5 * width), 0.5 * width - r, 0.01 * r);
        EXPECT_EQ(particles.motion[i].v[across], side_of(at) == 0 ? 0.5 : -0.5);
        EXPECT_TRUE(x[1] >= 4e-3 + r && x[1] <= 8e-3 - r && x[along] >= 4e-3 + r && x[along] <= 10e-3 - r);
      }
      seen = 1 + beads.model.feeding()->all();
      ASSERT_TRUE(beads.model.walls().touching.empty());
    }
    ASSERT_EQ(beads.model.feeding()->number, std::vector<std::int64_t>{9});
  }
}

/// A tube, plain, with layers that grow from below the ports on, and above a cone.
std::vector<core::Scene> flushed_tubes() {
  std::vector<core::Scene> scenes(3, flushed(core::ColumnShape::cylinder));
  scenes[1].column.layers = core::graded_layers(12e-3, 8, 2e-3, 1.2);
  scenes[1].column.cells[1] = int(scenes[1].column.layers.size());
  scenes[2].column.profile = {{0, 8e-3}, {2.5e-3, 12e-3}, {12e-3, 12e-3}};
  return scenes;
}

// Its part inside the curved side, measured along the radius, is in the cells at every step.
TEST(DemSidePorts, CountsAParticleInATubeAsFarAsItIsInside) {
  for (const core::Scene& scene : flushed_tubes()) {
    Beads beads(scene, {{"a", {6.2e-3, 6e-3, 10.5e-3}, {0, 0, 0.2}}});
    const double volume = measures::sphere_volume_below(r, 0, r);
    bool cut = false;
    while (true) {
      ASSERT_LT(beads.model.time(), 0.05);
      beads.steps(1);
      if (beads.model.particle_count() == 0) break;
      const dem::Vector& x = beads.place(0).x;
      const double inside = measures::sphere_volume_below(r, std::hypot(x[0] - 6e-3, x[2] - 6e-3), 6e-3);
      cut = cut || (inside > 0.3 * volume && inside < 0.7 * volume);
      ASSERT_NEAR(solids_of(beads.model), inside, 1e-9 * volume);
      ASSERT_GT(beads.motion(0).v[2], 0.1);
    }
    EXPECT_TRUE(cut);
    EXPECT_EQ(beads.model.outflow()->number, std::vector<std::int64_t>{1});
  }
}

TEST(DemSidePorts, TubesResumeWithTheSameBits) {
  for (core::Scene& scene : flushed_tubes()) {
    scene.feeds.push_back({"a", ColumnFace::left, {{0.0, 0.01}}, 0.2, {4e-3, 4e-3}, {8e-3, 8e-3}});
    const std::vector<Bead> start{{"a", {6.2e-3, 6e-3, 10.5e-3}, {0, 0, 0.2}}};
    Beads through(scene, start), again(scene, start);
    through.until(0.02);
    through.steps(16 - through.model.steps() % 16);  // to the end of a step of the fluid
    through.model.restart();
    again.model.resume(through.model.checkpoint());
    for (Beads* run : {&through, &again}) run->steps(160);
    EXPECT_GT(through.model.feeding()->all(), 0);
    expect_same_bits(through, again);
  }
}

}  // namespace
}  // namespace polybed::scenes
