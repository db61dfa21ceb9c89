// The room for spheres within cones and steps, by hand, and beds that start in them.
#include "dem/tapered_side.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "closures/sphere.hpp"
#include "dem/packing.hpp"
#include "dem/scene.hpp"

namespace polybed::dem::test {
namespace {

constexpr double r = 1e-3;
using Profile = std::vector<std::pair<double, double>>;

core::Column column_of(const Profile& profile) {
  core::Column column;
  column.dimensions = 3;
  column.shape = core::ColumnShape::cylinder;
  column.size = {40e-3, profile.back().first, 40e-3};
  column.cells = {16, 24, 16};
  column.profile = profile;
  return column;
}

/// A cone of 45 degrees from 20 to 40 mm, a step between the same diameters, and the cone upside down; then a tube.
const Profile cone{{0, 20e-3}, {10e-3, 40e-3}, {60e-3, 40e-3}},
    step{{0, 20e-3}, {10e-3, 20e-3}, {10e-3, 40e-3}, {60e-3, 40e-3}},
    funnel{{0, 40e-3}, {10e-3, 20e-3}, {60e-3, 20e-3}};

TEST(TaperedSide, LeavesRoomAsFarAsASphereTouches) {
  const TaperedSide in_cone(column_of(cone)), at_step(column_of(step));
  EXPECT_NEAR(in_cone.reach(5e-3, r), 15e-3 - std::sqrt(2.0) * r, 1e-15);
  EXPECT_NEAR(in_cone.reach(30e-3, r), 19e-3, 1e-15);
  EXPECT_NEAR(in_cone.reach(5e-3, 0), 15e-3, 1e-15);
  EXPECT_NEAR(at_step.reach(5e-3, r), 9e-3, 1e-15);
  EXPECT_NEAR(at_step.reach(10.6e-3, r), 10e-3 - 0.8e-3, 1e-15);  // the rim, 0.6 r below
  EXPECT_NEAR(at_step.reach(11.1e-3, r), 19e-3, 1e-15);
  EXPECT_NEAR(at_step.reach(-1, r), 9e-3, 1e-15);
  EXPECT_NEAR(at_step.reach(1, r), 19e-3, 1e-15);
}

// From the face of the step upward, from the cone along its normal, from the rim towards the axis.
TEST(TaperedSide, MovesSpheresOffItsWalls) {
  const TaperedSide in_cone(column_of(cone)), at_step(column_of(step));
  const auto moved = [](const TaperedSide& side, Vector x) {
    side.move_inside(x, r, r, 59e-3);
    return x;
  };
  const Vector up = moved(at_step, {35e-3, 10.6e-3, 20e-3});
  EXPECT_NEAR(up[0], 35e-3, 1e-11);
  EXPECT_NEAR(up[1], 11e-3, 1e-11);
  const Vector aside = moved(in_cone, {35e-3, 5e-3, 20e-3});  // its centre on the wall
  EXPECT_NEAR(aside[0], 35e-3 - r / std::sqrt(2.0), 1e-11);
  EXPECT_NEAR(aside[1], 5e-3 + r / std::sqrt(2.0), 1e-11);
  const Vector off_the_rim = moved(at_step, {20e-3, 10.6e-3, 29.5e-3});
  EXPECT_NEAR(off_the_rim[2], 29.2e-3, 1e-11);
  EXPECT_EQ(off_the_rim[1], 10.6e-3);
  const Vector free{24e-3, 5e-3, 20e-3};
  EXPECT_EQ(moved(in_cone, free), free);
  const Vector on_the_floor =
      moved(TaperedSide(column_of(funnel)), {38e-3, r, 20e-3});  // no lower, so towards the axis
  EXPECT_EQ(on_the_floor[1], r);
  EXPECT_NEAR(on_the_floor[0], 20e-3 + 19e-3 - std::sqrt(2.0) * r, 1e-11);
}

// 2000 spheres of two sizes: none overlaps another or a wall, and as many are below a height as its volume has room
// for, within four deviations of their number there, which hard spheres stay far below.
TEST(TaperedSide, StartsAreWithinIt) {
  for (const Profile& profile : {cone, step, funnel})
    for (const core::StartKind kind : {core::StartKind::mixed, core::StartKind::random}) {
      core::Scene scene;
      scene.column = column_of(profile);
      scene.fluid.name = "none";
      for (const double diameter : {2e-3, 1.5e-3}) {
        core::Species species;
        species.name = diameter > 1.8e-3 ? "coarse" : "fine";
        species.diameter = diameter;
        species.density = 2500;
        scene.species.push_back(species);
      }
      scene.bed.particles = {1000, 1000};
      scene.bed.start = {kind};
      scene.bed.solids_fraction = scene.bed.start_solids_fraction = 0.4;
      const Materials materials(scene);
      const Box box = box_of(scene);
      const std::vector<Particle> start = start_particles(scene, materials, box);
      ASSERT_EQ(start.size(), 2000u);
      double nearest = 1e9, top = 0;
      for (std::size_t i = 0; i < start.size(); ++i) {
        EXPECT_TRUE(box.within_side({start[i].place.x, start[i].place.radius * (1 - 1e-9)}));
        EXPECT_GE(start[i].place.x[1], start[i].place.radius * (1 - 1e-12));
        top = std::max(top, start[i].place.x[1] + start[i].place.radius);
        for (std::size_t j = 0; j < i; ++j) {
          const Vector &a = start[i].place.x, &b = start[j].place.x;
          nearest = std::min(nearest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) /
                                          (start[i].place.radius + start[j].place.radius));
        }
      }
      EXPECT_GE(nearest, 1);
      EXPECT_LE(top, scene.column.size[1] * (1 + 1e-12));
      const double solids = 1000 * (closures::sphere_volume(1e-3) + closures::sphere_volume(0.75e-3));
      const core::Column& column = scene.column;
      const double filled = kind == core::StartKind::random
                                ? column.size[1]
                                : column.filled_height(solids / 0.4 / column.cross_section());
      EXPECT_NEAR(top, filled, kind == core::StartKind::random ? 2e-3 : 1e-6);
      const double below = column.even_height(12e-3) / column.even_height(filled);
      double number = 0;
      for (const Particle& p : start) number += p.place.x[1] < 12e-3 ? 1 : 0;
      EXPECT_NEAR(number / 2000, below, 4 * std::sqrt(below * (1 - below) / 2000));
    }
}

}  // namespace
}  // namespace polybed::dem::test
