#include "closures/equation_of_state.hpp"

#include <gtest/gtest.h>

namespace polybed::closures {
namespace {

constexpr double atmosphere = 101325;

// sqrt(n (p_0 + B)/rho_0) = sqrt(7 * 300101325 / 998.207) = 1450.683 m/s, by hand.
TEST(TaitLiquid, SoundInWater) {
  const TaitLiquid water{998.207};
  EXPECT_DOUBLE_EQ(water.density(atmosphere), 998.207);
  EXPECT_NEAR(sound_speed(water, atmosphere), 1450.683, 0.001);
}

// 10 MPa above p_0: (310101325/300101325)^(1/7) = exp(ln(1.0333221)/7) = exp(0.03277899/7) = 1.00469369, by hand.
TEST(TaitLiquid, DensityUnderPressure) {
  const TaitLiquid water{998.207};
  EXPECT_NEAR(water.density(atmosphere + 1e7), 998.207 * 1.0046937, 998.207 * 2e-8);
  for (const double p : {-1e8, 0.0, 1e5, 1e9}) EXPECT_NEAR(water.pressure(water.density(p)), p, 1e-6 * 3e8);
}

TEST(TaitLiquid, CompressibilityIsTheSlopeOfTheDensity) {
  const TaitLiquid water{998.207};
  const double p = 5e6, step = 1e3;
  const double slope = (water.density(p + step) - water.density(p - step)) / (2 * step) / water.density(p);
  EXPECT_NEAR(water.compressibility(p) / slope, 1, 1e-7);  // round-off of the difference: 1e-16 * 3e8 / 1e3
}

// sqrt(287.05 * 293.15) = sqrt(84148.7) = 290.084 m/s; 101325/84148.7 = 1.204118 kg/m3, by hand.
TEST(IdealGas, Air) {
  const IdealGas air{287.05, 293.15};
  EXPECT_NEAR(sound_speed(air, atmosphere), 290.084, 0.001);
  EXPECT_NEAR(air.density(atmosphere), 1.204118, 1e-6);
  EXPECT_DOUBLE_EQ(air.pressure(air.density(5e4)), 5e4);
  EXPECT_DOUBLE_EQ(air.compressibility(2e5), 5e-6);
}

}  // namespace
}  // namespace polybed::closures
