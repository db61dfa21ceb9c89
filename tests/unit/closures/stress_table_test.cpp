// The tabulated function: through its knots, monotone, C1, held outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "closures/stress_table.hpp"

namespace polybed::closures {
namespace {

TEST(MonotoneCurve, GoesThroughItsKnotsWithSlopesByHand) {
  const MonotoneCurve curve({0.0, 0.2, 0.3}, {0.0, 2.0, 5.0});
  EXPECT_EQ(curve(0.0).pressure, 0);
  EXPECT_NEAR(curve(0.2).pressure, 2, 1e-15);
  EXPECT_EQ(curve(0.3).pressure, 5);
  // Secants 10 and 30, weight (0.2 + 0.2)/0.9 = 4/9 on 1/10: 1/(4/90 + 5/270) = 270/17.
  EXPECT_NEAR(curve(0.2).slope, 270.0 / 17, 1e-12);
  // Half way in the first piece: 1 - h m/8 = 1 - 0.2 (270/17)/8.
  EXPECT_NEAR(curve(0.1).pressure, 1 - 0.2 * 270 / 17 / 8, 1e-14);
  EXPECT_EQ(curve(-1.0).pressure, 0);
  EXPECT_EQ(curve(0.9).pressure, 5);
  EXPECT_EQ(curve(0.9).slope, 0);
}

TEST(MonotoneCurve, IsC1AndStaysBetweenItsKnots) {
  const MonotoneCurve curve({0.1, 0.3, 0.31, 0.5, 0.6}, {0.0, 1.0, 50.0, 51.0, 500.0});
  EXPECT_TRUE(curve.increases());
  for (double x = 0.05; x < 0.65; x += 0.00937) {
    constexpr double h = 1e-7;  // rounding of 500 over 2e-7, and h^2 times the third derivative (1e8): 1e-4 of 1e4
    EXPECT_NEAR((curve(x + h).pressure - curve(x - h).pressure) / (2 * h), curve(x).slope, 1e-5 * 1e4) << x;
    EXPECT_GE(curve(x + h).pressure, curve(x - h).pressure);
  }
  for (double knot : {0.1, 0.3, 0.31, 0.5, 0.6})
    EXPECT_NEAR(curve(knot - 1e-12).slope, curve(knot + 1e-12).slope, 1e-4) << knot;  // curvature 1e7 times 2e-12
}

TEST(MonotoneCurve, ATableThatFallsIsFound) {
  EXPECT_FALSE(MonotoneCurve({0.1, 0.2, 0.3}, {0.0, 2.0, 1.9}).increases());
  EXPECT_FALSE(MonotoneCurve({0.1, 0.2, 0.3}, {0.0, 0.0, 1.0}).increases());
  EXPECT_THROW(MonotoneCurve({0.1, 0.1}, {0.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(MonotoneCurve({0.1}, {0.0}), std::invalid_argument);
  EXPECT_THROW(MonotoneCurve({0.1, 0.2}, {0.0, std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace polybed::closures
