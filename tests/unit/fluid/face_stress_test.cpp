#include "fluid/face_stress.hpp"

#include <gtest/gtest.h>

namespace polybed::fluid {
namespace {

// 16/(sum phi sum 1/phi), by hand: 16/(1.2 * 24) for 0.5, 0.5, 0.1, 0.1. Round-off.
TEST(SolidEdge, IsTheHarmonicOverThePlainMean) {
  EXPECT_DOUBLE_EQ(SolidEdge::of(0.3, 0.3, 0.3, 0.3), 1);
  EXPECT_DOUBLE_EQ(SolidEdge::of(0.5, 0.5, 0.1, 0.1), 16 / 28.8);
  EXPECT_DOUBLE_EQ(SolidEdge::of(0.5, 0.1, 0.5, 0.1), 16 / 28.8);
}

TEST(SolidEdge, TransmitsNothingWhereSolidsEnd) {
  EXPECT_EQ(SolidEdge::of(0.5, 0.5, 0.5, 0), 0);
  EXPECT_EQ(SolidEdge::of(0.5, 0.5, -1e-6, 0.5), 0);
  EXPECT_EQ(SolidEdge::of(1e-100, 1e-100, 1e-100, 1e-100), 0);  // their products are below the least double
  EXPECT_LT(SolidEdge::of(0.5, 0.5, 0.5, 1e-9), 1e-7);          // and gently so: 16 phi/1.5 near 0
}

// 1 + delta from cell to cell: the share is 1 - delta^2/4 to second order, delta on one axis.
TEST(SolidEdge, IsOneToSecondOrder) {
  constexpr double delta = 1e-3;
  EXPECT_NEAR(SolidEdge::of(1 + delta, 1, 1 + delta, 1), 1 - delta * delta / 4, 2 * delta * delta * delta);
}

}  // namespace
}  // namespace polybed::fluid
