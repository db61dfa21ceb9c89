#include "closures/hopper_discharge.hpp"

#include <gtest/gtest.h>

namespace polybed::closures {
namespace {

// 2 mm, 1500 kg/m3 of bed, 20 mm: 20 - 1.4 2 = 17.2 mm; (0.0172)^2.5 = 3.879905e-5, 0.583 1500 sqrt(9.81) = 2739.014,
// so 0.1062712 kg/s. A slot of the same width and 30 mm: 1.03 1500 sqrt(9.81) 0.03 = 145.1725, (0.0172)^1.5
// = 2.255759e-3.
TEST(HopperDischarge, OfBeverlooByHand) {
  EXPECT_NEAR(hopper_discharge(0.02, 0, 2e-3, 1500, 9.81), 0.1062712, 1e-7);  // digits of the hand value
  EXPECT_NEAR(hopper_discharge(0.02, 0.03, 2e-3, 1500, 9.81), 145.1725 * 2.255759e-3, 1e-6);
}

TEST(HopperDischarge, IsNothingThroughWhatTheRimCloses) {
  EXPECT_EQ(hopper_discharge(2.8e-3, 0, 2e-3, 1500, 9.81), 0);
  EXPECT_EQ(hopper_discharge(1e-3, 0.1, 2e-3, 1500, 9.81), 0);
}

TEST(HopperDischarge, GrowsByItsPowers) {
  EXPECT_NEAR(
      hopper_discharge(0.04 + 2.8e-3, 0, 2e-3, 1500, 9.81) / hopper_discharge(0.01 + 2.8e-3, 0, 2e-3, 1500, 9.81), 32,
      1e-9);  // 4^2.5
  EXPECT_NEAR(
      hopper_discharge(0.04 + 2.8e-3, 1, 2e-3, 1500, 9.81) / hopper_discharge(0.01 + 2.8e-3, 1, 2e-3, 1500, 9.81), 8,
      1e-9);  // 4^1.5
}

}  // namespace
}  // namespace polybed::closures
