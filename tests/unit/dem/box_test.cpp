#include "dem/box.hpp"

#include <gtest/gtest.h>

#include <random>

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

}  // namespace
}  // namespace polybed::dem
