// Logarithm and exponential without branches against those of the C++ library.
#include "closures/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace polybed::closures {
namespace {

TEST(Elementary, AreThoseOfTheLibrary) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> wide(-690, 690), narrow(-2, 2);
  for (int n = 0; n < 100'000; ++n) {
    const double x = n % 2 == 0 ? wide(random) : narrow(random), power = std::exp(x), logarithm = std::log(power);
    // As stated, and half a unit in the last place of the library's own.
    EXPECT_NEAR(plain_exp(x), power, 6e-16 * power);
    EXPECT_NEAR(plain_log(power), logarithm, 6e-16 * std::max(1.0, std::abs(logarithm)));
  }
  EXPECT_EQ(plain_exp(0), 1);
  EXPECT_EQ(plain_log(1), 0);
}

}  // namespace
}  // namespace polybed::closures
