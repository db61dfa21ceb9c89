#include "closures/own_wake.hpp"

#include <gtest/gtest.h>

namespace polybed::closures {
namespace {

// (3/2) int_0^1 (1 - x^2) [1 - sqrt(pi/2) x R exp(x^2 R^2/2) erfc(x R/sqrt 2)] dx by scipy's quad and erfcx, which
// agrees to 12 digits with the same integral over wave numbers.
TEST(OwnWake, InertiaAsTheIntegral) {
  for (const auto& [r, psi] : {std::pair{1e-3, 0.999530207120},
                               {9.9e-3, 0.995366597533},
                               {1.01e-2, 0.995273394296},
                               {0.1, 0.954925150024},
                               {1.0, 0.672874990663},
                               {5.0, 0.281446385977},
                               {19.9, 0.087353380594},
                               {20.1, 0.086550025340},
                               {1e4, 1.87967124357e-4}})
    EXPECT_NEAR(own_wake_inertia(r), psi, 1e-7 * psi) << r;  // of the series below 0.01
  EXPECT_EQ(own_wake_inertia(0), 1);
}

// sqrt(2/pi)/(6 pi 10 0.02) = 0.2116455 m/(s N); the limit of a fast one is 1/(4 pi rho U s^2), whatever the viscosity.
TEST(OwnWake, ByHand) {
  EXPECT_NEAR(own_wake(10, 1400, 0.02, 0), 0.2116455, 1e-7);
  const double fast = 1 / (4 * std::numbers::pi * 1000 * 1 * 1e-4);
  EXPECT_NEAR(own_wake(1e-6, 1000, 0.01, 1), fast, 1e-6 * fast);
  EXPECT_NEAR(own_wake(1e-7, 1000, 0.01, 1), fast, 1e-7 * fast);
}

}  // namespace
}  // namespace polybed::closures
