// Lift in shear: value, direction, limits, and where Mei's fit jumps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "closures/lift_saffman_mei.hpp"

namespace polybed::closures {
namespace {

constexpr double bead_size = 1e-3, rho = 1000, mu = 1e-3;

TEST(LiftSaffmanMei, ByHand) {
  // Computed apart from this code. Slip 20 mm/s: Re_p 20; omega 8 1/s: a 0.2.
  EXPECT_NEAR(lift_share_mei(20, 0.2), 0.26348428855253603, 1e-15);
  const Vec3 lift = lift_saffman_mei({0.02, 0, 0}, {0, 0, -8}, bead_size, rho, mu);
  EXPECT_NEAR(lift.y, 2.4071449310572182e-08, 1e-21);
  EXPECT_EQ(lift.x, 0);
  EXPECT_EQ(lift.z, 0);
  // Re_p 0.05, Saffman alone: 1.615 1e-6 sqrt(1/2) 5e-5 2.
  EXPECT_NEAR(lift_saffman_mei({5e-5, 0, 0}, {0, 0, -2}, bead_size, rho, mu).y, 1.615e-10 * std::sqrt(0.5), 1e-24);
  EXPECT_NEAR(lift_share_mei(100, 0.2), 0.23433992404197798, 1e-15);  // 0.0524 sqrt 20
}

TEST(LiftSaffmanMei, PushesALaggingSphereTowardsFasterFluid) {
  // u_f = (3 y, 0, 0): curl u_f = (0, 0, -3). The sphere is slower than the fluid: slip along +x, force along +y.
  EXPECT_GT(lift_saffman_mei({0.01, 0, 0}, {0, 0, -3}, bead_size, rho, mu).y, 0);
  EXPECT_LT(lift_saffman_mei({-0.01, 0, 0}, {0, 0, -3}, bead_size, rho, mu).y, 0);
  // No force when the slip is along the vorticity, and none along slip or vorticity.
  EXPECT_EQ(lift_saffman_mei({0, 0, 0.01}, {0, 0, -3}, bead_size, rho, mu).y, 0);
  const Vec3 slip{0.01, -0.02, 0.005}, vorticity{1, 2, -4},
      force = lift_saffman_mei(slip, vorticity, bead_size, rho, mu);
  const double size = std::sqrt(dot(force, force));
  EXPECT_NEAR(dot(force, slip), 0, 1e-15 * size);       // round-off of three products
  EXPECT_NEAR(dot(force, vorticity), 0, 1e-14 * size);  // the same, |vorticity| 4.6
}

TEST(LiftSaffmanMei, VanishesWithSlipAndWithVorticity) {
  for (const double slip : {0.0, 1e-300, 1e-160, 1e-20})
    for (const double spin : {0.0, 1e-300, 1e-160, 1e-20, 5.0}) {
      const Vec3 force = lift_saffman_mei({slip, 0, 0}, {0, 0, spin}, bead_size, rho, mu);
      EXPECT_TRUE(std::isfinite(force.y));
      // Never above Saffman's own 1.615 d^2 sqrt(mu rho_f omega) w, here with the least omega put in.
      EXPECT_LE(std::abs(force.y), 1.615e-6 * std::sqrt(std::max(spin, 1e-150)) * slip);
    }
  EXPECT_EQ(lift_saffman_mei({0, 0, 0}, {1, 2, 3}, bead_size, rho, mu).x, 0);
  EXPECT_EQ(lift_saffman_mei({1, 2, 3}, {0, 0, 0}, bead_size, rho, mu).x, 0);
  EXPECT_NE(lift_saffman_mei({1e-20, 0, 0}, {0, 0, 1e-20}, bead_size, rho, mu).y, 0);
}

// Below the least shear, here omega = 2 x 0.005 x 0.02/1e-3 = 0.2 1/s, half the vorticity is half the force; there and
// above it is Saffman's.
TEST(LiftSaffmanMei, IsLinearBelowTheLeastShear) {
  const auto force = [](double omega, double least) {
    return lift_saffman_mei({0.02, 0, 0}, {0, 0, -omega}, bead_size, rho, mu, least).y;
  };
  EXPECT_NEAR(force(0.1, lift_least_shear_mei) / force(0.2, lift_least_shear_mei), 0.5, 1e-15);
  EXPECT_NEAR(force(0.1, 0) / force(0.2, 0), std::sqrt(0.5), 1e-15);
  for (const double omega : {0.2001, 8.0}) EXPECT_EQ(force(omega, lift_least_shear_mei), force(omega, 0));
  EXPECT_EQ(lift_saffman_mei({0, 0, 0}, {0, 0, 3}, bead_size, rho, mu, lift_least_shear_mei).y, 0);
}

TEST(LiftSaffmanMei, ShareIsHeldInItsRange) {
  EXPECT_EQ(lift_share_mei(0.09, 0.2), 1);
  EXPECT_EQ(lift_share_mei(10, 0), lift_share_mei(10, 0.005));
  EXPECT_EQ(lift_share_mei(10, 7), lift_share_mei(10, 0.4));
  EXPECT_NEAR(lift_share_mei(10, 0.005), 0.38269225012543523, 1e-15);
  EXPECT_NEAR(lift_share_mei(10, 0.4), 0.5003692322068252, 1e-15);
  EXPECT_EQ(lift_share_mei(1000, 0.4), 1);  // 0.0524 sqrt 400 = 1.048
  for (double re = 0; re < 2000; re += 0.37)
    for (const double a : {0.001, 0.005, 0.1, 0.4, 2.0}) {
      EXPECT_GT(lift_share_mei(re, a), 0);
      EXPECT_LE(lift_share_mei(re, a), 1);
      if (re < 39) {
        EXPECT_LE(lift_share_mei(re + 0.37, a), lift_share_mei(re, a));
      } else if (re > 40) {
        EXPECT_GE(lift_share_mei(re + 0.37, a), lift_share_mei(re, a));
      }
    }
}

TEST(LiftSaffmanMei, JumpsOfTheFitAreAsSaid) {
  for (const double a : {0.005, 0.05, 0.4}) {
    const double floor = 0.3314 * std::sqrt(a), at_40 = lift_share_mei(40, a) - lift_share_mei(40 + 1e-9, a);
    // 0.0524 sqrt 40 = 0.33141: 1e-5 of sqrt a beside the jump.
    EXPECT_NEAR(at_40, (1 - floor) * std::exp(-4.0), 1.1e-5);
    EXPECT_LT(at_40, 0.0184);
    EXPECT_LT(1 - lift_share_mei(0.1, a), 0.01);
  }
}

}  // namespace
}  // namespace polybed::closures
