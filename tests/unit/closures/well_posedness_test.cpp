// The critical slope of the solids pressure, against values computed apart.
#include "closures/well_posedness.hpp"

#include <gtest/gtest.h>

namespace polybed::closures {
namespace {

// 1 mm, 2200 kg/m3, water at 20 degC, 50 mm/s, voidage .76397 after `cello`: 1.1585 Pa (a generalised eigenvalue
// solver).
TEST(WellPosedness, CriticalSlopeOfALiquidBed) {
  EXPECT_NEAR(critical_slope(1 - 0.76397, 2200, 998.207, 0.05 / 0.76397), 1.1585, 5e-4);
}

// By hand: phi .5, rho_s 2, rho_f 2, w 3: .5 2 2 9/(1 + 1) = 9; a = b = 4, growth 5 sqrt(9/.5/8) = 7.5, as k w
// sqrt(a b)/(a + b) = 5 3/2.
TEST(WellPosedness, GrowthByHand) {
  EXPECT_DOUBLE_EQ(critical_slope(0.5, 2, 2, 3), 9.0);
  EXPECT_DOUBLE_EQ(growth_without_drag(5, 0.5, 2, 2, 3, 0), 7.5);
  EXPECT_DOUBLE_EQ(growth_without_drag(10, 0.5, 2, 2, 3, 0), 15.0);  // without bound as waves become short
}

TEST(WellPosedness, NoGrowthFromTheCriticalSlopeOn) {
  EXPECT_GT(growth_without_drag(1, 0.5, 2, 2, 3, 9 * (1 - 1e-9)), 0);
  EXPECT_EQ(growth_without_drag(1, 0.5, 2, 2, 3, 9.0), 0);
  EXPECT_EQ(critical_slope(0.5, 2, 2, 0), 0);  // no slip, nothing to grow from
}

}  // namespace
}  // namespace polybed::closures
