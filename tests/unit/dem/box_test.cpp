#include "dem/box.hpp"
#include "core/numerics/inner_walls.hpp"

#include <gtest/gtest.h>

#include <random>
#include <tuple>

#include "core/case/scene.hpp"
#include "dem/scene.hpp"

namespace polybed::dem {
namespace {

int pushing(const Box& box, const Vector& centre) {
  int n = 0;
  for (std::size_t p = 0; p < box.plates.size(); ++p) n += box.pushes(int(p), centre) ? 1 : 0;
  return n;
}

/// The nearest point of what pushes is that of all plates: nothing that should push is left out.
void expect_nearest_pushes(const Box& box, const Vector& centre) {
  const auto distance = [&](const Plate& plate) { return std::hypot(plate.to(centre)[0], plate.to(centre)[1]); };
  double of_all = 1e9, of_pushing = 1e9;
  for (std::size_t p = 0; p < box.plates.size(); ++p) {
    of_all = std::min(of_all, distance(box.plates[p]));
    if (box.pushes(int(p), centre)) of_pushing = std::min(of_pushing, distance(box.plates[p]));
  }
  EXPECT_NEAR(of_pushing, of_all, 1e-8) << centre[0] << ' '
                                        << centre[1];  // the width of an edge, 1e-9 of a plate of 2 m
}

TEST(Box, PlatesThatContinueEachOtherPushOnce) {
  for (const bool turned : {false, true}) {
    Box box;
    box.add_plate({0.1, 0.2, 0.4, 0.35});
    box.add_plate(turned ? Plate{1.2, 0.75, 0.4, 0.35} : Plate{0.4, 0.35, 1.2, 0.75});
    EXPECT_EQ(box.joints.size(), 2U);
    for (int n = -1000; n <= 1000; ++n) {
      const double along = 0.4 + 1e-4 * n;  // n = 0: above the joint itself
      const Vector above{along - 0.05, 0.35 + 0.5 * (along - 0.4) + 0.1, 0};
      EXPECT_EQ(pushing(box, above), 1) << along;
    }
  }
}

TEST(Box, ACornerPushesOnceFromOutsideAndTwiceFromWithin) {
  Box box;
  box.add_plate({0, 0, 1, 0});
  box.add_plate({0, 1, 0, 0});
  EXPECT_EQ(pushing(box, {-0.1, -0.1, 0}), 1);
  EXPECT_EQ(pushing(box, {0.1, 0.1, 0}), 2);
  EXPECT_EQ(pushing(box, {0.1, -0.1, 0}), 1);  // below the first, nearer to it than to the corner
  EXPECT_EQ(pushing(box, {1.1, 0.5, 0}), 2);   // beside the free edge of the first, before the face of the second
}

TEST(Box, AnEdgeOnAFaceDoesNotPushBesideIt) {
  Box box;
  box.add_plate({0, 0, 2, 0});
  box.add_plate({1, 0, 1, 1});
  EXPECT_EQ(pushing(box, {0.9, 0.1, 0}), 2);
  EXPECT_EQ(pushing(box, {1, -0.1, 0}), 1);
}

TEST(Box, PlatesApartKeepTheirEdges) {
  Box box;
  box.add_plate({0, 0, 1, 0});
  box.add_plate({1.001, 0, 2, 0});
  EXPECT_TRUE(box.joints.empty());
  EXPECT_EQ(pushing(box, {1.0005, 0.01, 0}), 2);
}

/// 20 m wide and deep: its axis is at (10, 10).
Box tall_box() {
  Box box;
  box.size = {20, 30, 20};
  box.walls.push_back({1, 0, 0});
  return box;
}

/// A centre at a distance from the axis, in the direction (0.6, 0.8), and a height.
Vector beside_axis(double distance, double height) { return {10 + 0.6 * distance, height, 10 + 0.8 * distance}; }

void expect_near(const Vector& obtained, const Vector& expected) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(obtained[k], expected[k], 1e-13) << "axis " << k;
}

// A cone of diameters 6 and 12 m, 4 m high: its profile rises along (3, 4)/5, its normal inwards is (-4, 3)/5.
TEST(Box, AConeIsNearestAlongItsNormal) {
  Box box = tall_box();
  box.add_cone({3, 0}, {6, 4});
  const Plate& cone = box.plates[0];
  // 1 m inwards and outwards of its middle, and beyond both edges
  expect_near(cone.to(beside_axis(4.5 - 0.8, 2 + 0.6)), {-0.8 * 0.6, 0.6, -0.8 * 0.8});
  expect_near(cone.to(beside_axis(4.5 + 0.8, 2 - 0.6)), {0.8 * 0.6, -0.6, 0.8 * 0.8});
  expect_near(cone.to(beside_axis(2, -1)), {-0.6, -1, -0.8});
  expect_near(cone.to(beside_axis(7, 6)), {0.6, 2, 0.8});
  EXPECT_DOUBLE_EQ(std::hypot(cone.to({10, 0, 10})[0], cone.to({10, 0, 10})[1]), 3);  // on the axis: some way aside
}

// 1/R = cos(a)/rho of the point that is nearest, cos(a) = 4/5, above 0 from inside. Half a step in curvature is
// 0.8 (1/3 - 1/6)/32.
TEST(Box, AConeCurvesMoreWhereItIsNarrow) {
  Box box = tall_box();
  box.add_cone({3, 0}, {6, 4});
  const double half_step = 0.8 * (1.0 / 3 - 1.0 / 6) / 32;
  for (int n = 0; n <= 100; ++n) {
    const double share = 0.01 * n, rho = 3 + 3 * share, y = 4 * share;
    for (const double inwards : {0.5, -0.5}) {
      const int curve = box.plates[0].curve_at(beside_axis(rho - 0.8 * inwards, y + 0.6 * inwards));
      if (curve == 0) {  // rounding may find the edge
        EXPECT_TRUE(n == 0 || n == 100);
        continue;
      }
      const double expected = (inwards > 0 ? 0.8 : -0.8) / rho;
      EXPECT_NEAR(box.curvatures.at(std::size_t(curve - 1)), expected, half_step * (1 + 1e-9)) << share;
    }
  }
  EXPECT_EQ(box.plates[0].curve_at(beside_axis(2, -1)), 0) << "an edge";
}

TEST(Box, ACylinderHasOneCurvatureOnEitherSideAndARingNone) {
  Box box = tall_box();
  box.add_cone({5, 0}, {5, 10});
  box.add_cone({5, 10}, {8, 10});
  EXPECT_EQ(box.curvatures, (std::vector<double>{0.2, -0.2}));
  EXPECT_EQ(box.plates[0].curve_at(beside_axis(4, 3)), 1);
  EXPECT_EQ(box.plates[0].curve_at(beside_axis(6, 3)), 2);
  EXPECT_EQ(box.plates[1].curve_at(beside_axis(6, 11)), 0);
}

TEST(Box, RoundWallsThatJoinPushOnce) {
  Box box = tall_box();
  box.openings = {{1, 0, 0, {10, 0, 10}, {3, 0, 0}, true}};
  box.add_cone({3, 0}, {6, 4});     // from the rim of the opening
  box.add_cone({6, 12}, {6, 4});    // a cylinder above it
  box.add_cone({10, 20}, {6, 12});  // and a cone to the side of the box
  box.add_cone({10, -3000}, {10, 3000});
  box.make_bottom_a_plate();
  const auto touched = [&](const Vector& centre, double radius) {
    int n = 0;
    for (std::size_t p = 0; p < box.plates.size(); ++p) {
      const Vector away = box.plates[p].to(centre);
      if (box.pushes(int(p), centre) && std::hypot(away[0], away[1], away[2]) < radius) ++n;
    }
    return n;
  };
  EXPECT_EQ(touched(beside_axis(2.9, -0.1), 0.2), 1) << "below the rim, where cone and bottom end";
  EXPECT_EQ(touched(beside_axis(3 - 0.08, 0.06 + 1e-3), 0.2), 1) << "above the rim, over the cone's face";
  EXPECT_EQ(touched(beside_axis(6.1, 3.9), 0.2), 1) << "outside, where cone and cylinder continue each other";
  EXPECT_EQ(touched(beside_axis(5.9, 12.05), 0.2), 1) << "inside, over an edge";
  EXPECT_EQ(touched(beside_axis(9.9, 20.05), 0.2), 1) << "the side alone: the cone ends on it";
  EXPECT_EQ(touched(beside_axis(9.8, 19.9), 0.25), 2) << "in the corner of cone and side";
  EXPECT_EQ(touched(beside_axis(8, 0.1), 0.2), 1) << "the bottom";
}

TEST(Box, WhatIsNearestPushesWhereverPlatesMeet) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1, 1);
  for (int n = 0; n < 1000; ++n) {
    const Vector a{place(random), place(random), 0};
    Box box;
    for (int k = 0; k < 3; ++k) {
      const Vector b{place(random), place(random), 0};
      box.add_plate(k == 1 ? Plate{a[0], a[1], b[0], b[1]} : Plate{b[0], b[1], a[0], a[1]});
    }
    EXPECT_GE(box.joints.size(), 6U);
    for (int m = 0; m < 20; ++m) expect_nearest_pushes(box, {place(random), place(random), 0});
  }
}

// A cone in the profile of a round column is the cone of a [[wall]] in an even one, and a step is a flat ring; what
// ends at the top goes on above it.
TEST(Box, HasTheWallsOfATaperedColumn) {
  core::Scene scene;
  scene.column.shape = core::ColumnShape::cylinder;
  scene.column.dimensions = 3;
  scene.column.size = {0.2, 0.5, 0.2};
  scene.fluid.name = "none";
  core::Scene given = scene;
  given.walls = {{{0.06, 0}, {0.1, 0.1}, core::WallShape::cone}, {{0.1, 0.1}, {0.2, 0.1}, core::WallShape::cone}};
  scene.column.profile = {{0, 0.06}, {0.1, 0.1}, {0.1, 0.2}, {0.5, 0.2}};
  const Box tapered = box_of(scene), with_walls = box_of(given);
  ASSERT_EQ(tapered.plates.size(), with_walls.plates.size());
  for (std::size_t n = 0; n < tapered.plates.size(); ++n) {
    const Plate &one = tapered.plates[n], &other = with_walls.plates[n];
    EXPECT_EQ(std::tie(one.x, one.y, one.along_x, one.along_y),
              std::tie(other.x, other.y, other.along_x, other.along_y));
  }
  EXPECT_EQ(tapered.joints.size(), with_walls.joints.size());
  scene.column.profile = {{0, 0.2}, {0.4, 0.2}, {0.5, 0.1}};
  const Box narrow = box_of(scene);
  EXPECT_EQ(narrow.plates.size(), 4U);  // cone, what goes on above it, side and bottom
  EXPECT_EQ(narrow.plates[1].x, 0.05);
  EXPECT_GT(narrow.plates[1].along_y, 10);
}

// Particles touch the surface that cuts the cells of a fluid: the same distance from the same list.
TEST(Box, ThickWallsAreThoseThatCutTheFluid) {
  core::Scene scene;
  scene.column.size = {1, 1, 1};
  scene.column.dimensions = 3;
  for (const bool round : {false, true}) {
    if (round)
      scene.walls = {{{0.3, 0.2}, {0.3, 0.5}, core::WallShape::cylinder, 0.1},
                     {{0.4, 0.7}, {0.8, 0.9}, core::WallShape::cone, 0.05}};
    else
      scene.walls = {{{0.2, 0.3}, {0.6, 0.4}, core::WallShape::flat, 0.1},
                     {{0.7, 0.8}, {0.7, 0.8}, core::WallShape::rod, 0.2}};
    const core::InnerWalls walls(scene.walls, scene.column.size, false);
    Box box;
    box.size = {1, 1, 1};
    for (const core::InnerWall& wall : scene.walls)
      round ? box.add_cone({0.5 * wall.from[0], wall.from[1]}, {0.5 * wall.to[0], wall.to[1]}, wall.thickness)
            : box.add_plate({wall.from[0], wall.from[1], wall.to[0], wall.to[1]}, wall.thickness);
    int outside = 0;
    for (int n = 0; n < 2000; ++n) {
      const Vector x{0.001 * (n * 37 % 1000), 0.001 * (n * 211 % 1000), 0.001 * (n * 503 % 1000)};
      const core::FromWall wall = walls.nearest(x);
      if (!(wall.distance > 0)) continue;
      ++outside;
      double least = 10, along_x = 0;
      for (const Plate& plate : box.plates) {
        const Vector to = plate.to(x);
        const double distance = std::sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
        if (distance < least) along_x = to[0];
        least = std::min(least, distance);
      }
      EXPECT_NEAR(along_x, least * wall.away[0], 1e-12);
      EXPECT_NEAR(least, wall.distance, 1e-12);
    }
    EXPECT_GT(outside, 1000);
  }
}

TEST(Box, EqualRodsAndPlatesApartAllPush) {
  Box box;
  box.add_plate({0.2, 0.5, 0.2, 0.5}, 0.1);
  box.add_plate({0.7, 0.5, 0.7, 0.5}, 0.1);
  box.add_plate({0.3, 0.9, 0.6, 0.9}, 0.1);
  EXPECT_TRUE(box.joints.empty());
  EXPECT_EQ(pushing(box, {0.7, 0.6, 0}), 3);
  EXPECT_NEAR(box.plates[1].gap({0.7, 0.52}), -0.03, 1e-15);  // inside
}

/// How often thick plates push a centre with one point, or with a point inside another plate; the nearest has to push.
void expect_once_from_outside(const Box& box, const InPlane& point) {
  for (const Plate& plate : box.plates)
    if (!(plate.gap(point) > 1e-3)) return;
  std::vector<InPlane> pushing;
  double of_all = 1e9, of_pushing = 1e9;
  for (std::size_t p = 0; p < box.plates.size(); ++p) {
    const InPlane to = box.plates[p].to(point), at{point[0] - to[0], point[1] - to[1]};
    of_all = std::min(of_all, std::hypot(to[0], to[1]));
    if (!box.pushes(int(p), {point[0], point[1], 0})) continue;
    of_pushing = std::min(of_pushing, std::hypot(to[0], to[1]));
    for (const Plate& other : box.plates) EXPECT_GT(other.gap(at), -1e-9) << point[0] << ' ' << point[1];
    for (const InPlane& before : pushing) EXPECT_GT(std::hypot(at[0] - before[0], at[1] - before[1]), 1e-9);
    pushing.push_back(at);
  }
  EXPECT_NEAR(of_pushing, of_all, 1e-8) << point[0] << ' ' << point[1];
}

// Rods through each other, a rod in a plate, plates across each other, ending on each other or in one line; of one
// thickness or of two.
TEST(Box, ThickWallsThatOverlapPushOnce) {
  for (const double thick : {0.1, 0.16}) {
    std::vector<Box> boxes(5);
    boxes[0].add_plate({0.45, 0.5, 0.45, 0.5}, 0.1);
    boxes[0].add_plate({0.5, 0.52, 0.5, 0.52}, thick);
    boxes[1].add_plate({0.2, 0.4, 0.8, 0.5}, 0.1);
    boxes[1].add_plate({0.5, 0.5, 0.5, 0.5}, thick);
    boxes[2].add_plate({0.2, 0.5, 0.8, 0.5}, 0.1);
    boxes[2].add_plate({0.5, 0.2, 0.5, 0.8}, thick);
    boxes[3].add_plate({0.2, 0.5, 0.8, 0.5}, 0.1);
    boxes[3].add_plate({0.5, 0.5, 0.5, 0.8}, thick);
    boxes[4].add_plate({0.2, 0.5, 0.5, 0.5}, 0.1);
    boxes[4].add_plate({0.4, 0.5, 0.8, 0.5}, thick);
    for (std::size_t n = 0; n < boxes.size(); ++n) {
      SCOPED_TRACE(n);
      EXPECT_EQ(boxes[n].overlaps.size(), 2U);
      for (int k = 0; k < 10'000; ++k) expect_once_from_outside(boxes[n], {0.01 * (k % 100), 0.01 * (k / 100)});
    }
    EXPECT_EQ(pushing(boxes[3], {0.35, 0.62, 0}), 2);  // in the corner of two plates
  }
}

// A rod curves with its own radius, 1/R* = sqrt((1/r)(1/r + 1/R)); a draft tube inside with half its thickness less
// than its middle, outside with as much more.
TEST(Box, ThickWallsCurveAtTheirSurface) {
  Box box;
  box.size = {1, 1, 1};
  box.add_plate({0.7, 0.8, 0.7, 0.8}, 0.2);
  box.add_cone({0.2, 0.2}, {0.2, 0.5}, 0.1);
  ASSERT_EQ(box.curvatures.size(), 3U);
  EXPECT_NEAR(box.curvatures[0], -1 / 0.1, 1e-12);
  EXPECT_NEAR(box.curvatures[1], 1 / 0.15, 1e-12);
  EXPECT_NEAR(box.curvatures[2], -1 / 0.25, 1e-12);
  EXPECT_EQ(box.plates[0].curve_at({0.9, 0.8, 0.3}), 1);
}

}  // namespace
}  // namespace polybed::dem
