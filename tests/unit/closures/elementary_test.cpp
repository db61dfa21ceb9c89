// Logarithm, exponential, power and arctangent without branches against those of the C++ library.
#include "closures/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
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

TEST(Elementary, PowersAreThoseOfTheLibrary) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> wide(-60, 60), narrow(-1, 1), exponent(-4, 5);
  for (int n = 0; n < 100'000; ++n) {
    const bool near = n % 2 == 0;
    const double x = std::pow(10, near ? narrow(random) : wide(random)), p = exponent(random);
    const double power = std::pow(x, p);
    EXPECT_NEAR(plain_power(x, p), power, (near ? 3e-15 : 4e-13) * power) << x << ' ' << p;
  }
  EXPECT_EQ(plain_power(0, 0.687), 0);
  EXPECT_EQ(plain_power(1, -3.65), 1);
  EXPECT_TRUE(std::isnan(plain_power(std::nan(""), 0.687)));
}

TEST(Elementary, ArctangentIsThatOfTheLibrary) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> magnitude(-20, 20);
  for (int n = 0; n < 100'000; ++n) {
    const double x = (n % 2 == 0 ? 1 : -1) * std::pow(10, magnitude(random)), angle = std::atan(x);
    EXPECT_NEAR(plain_arctan(x), angle, 8e-16 * std::abs(angle)) << x;
  }
  EXPECT_EQ(plain_arctan(0), 0);
  EXPECT_EQ(plain_arctan(std::numeric_limits<double>::infinity()), 0.5 * std::numbers::pi);
  EXPECT_TRUE(std::isnan(plain_arctan(std::nan(""))));
}

}  // namespace
}  // namespace polybed::closures
