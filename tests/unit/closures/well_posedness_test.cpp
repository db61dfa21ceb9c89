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

TEST(WellPosedness, CriticalSlopeByHand) {
  EXPECT_DOUBLE_EQ(critical_slope(0.5, 2, 2, 3), 9.0);  // .5 2 2 9/(1 + 1)
  EXPECT_EQ(critical_slope(0.5, 2, 2, 0), 0);           // no slip, nothing to grow from
}

}  // namespace
}  // namespace polybed::closures
