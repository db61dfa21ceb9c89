#include "closures/sphere.hpp"

#include <gtest/gtest.h>

namespace polybed::closures {
namespace {

// By hand: 4/3 pi 1.5^3 = 4.5 pi = 14.1371669411541; 1e-13 is the last of these digits.
TEST(Sphere, HasTheVolumeOfArchimedes) {
  EXPECT_NEAR(sphere_volume(1.5), 14.1371669411541, 1e-13);
  EXPECT_EQ(sphere_volume(0), 0.0);
}

// Halves and doubles are exact: of a diameter it is pi/6 D^3, to the bit.
TEST(Sphere, HasTheSameVolumeByItsDiameter) {
  const double d = 0.807e-3;
  EXPECT_EQ(sphere_volume(0.5 * d), std::numbers::pi / 6 * d * d * d);
}

}  // namespace
}  // namespace polybed::closures
