// Tangential springs, the cap and the transport of their history, by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "closures/contact_pair.hpp"
#include "closures/contact_tangential.hpp"

namespace polybed::closures {
namespace {

void expect_near(const Vec3& is, const Vec3& expected, double tolerance) {
  EXPECT_NEAR(is.x, expected.x, tolerance);
  EXPECT_NEAR(is.y, expected.y, tolerance);
  EXPECT_NEAR(is.z, expected.z, tolerance);
}

TEST(Vector, Products) {
  EXPECT_EQ(dot({1, 2, 3}, {4, -5, 6}), 12);
  expect_near(cross({1, 2, 3}, {4, -5, 6}), {27, 6, -13}, 0);
}

TEST(Tangential, StiffnessAndDamping) {
  EXPECT_DOUBLE_EQ(tangential_stiffness(5e9, 1e-4), 4e6);
  EXPECT_DOUBLE_EQ(secant_stiffness_hdd(5e9, 1e-4), 8e6 / 3);
  // sqrt(S_t/S_n) of aluminium on steel, computed apart.
  const Elastic aluminium{70e9, .33}, steel{200e9, .25};
  EXPECT_NEAR(
      tangential_damping_ratio(reduced_shear_modulus(aluminium, steel), reduced_youngs_modulus(aluminium, steel)),
      0.9035648104114797, 1e-14);
}

TEST(Tangential, SpringAndDashpot) { expect_near(spring_force(100, {1, -2, 0}, 10, {3, 0, 1}), {-130, 200, -10}, 0); }

TEST(Tangential, MindlinSpringFallsWithTheContactAlone) {
  // Growing: 5 - 100 2 0.01; shrinking to half: 2.5 - 2.
  expect_near(mindlin_force({5, 0, -1}, 1, 2, 100, {2, 0, 0}, .01), {3, 0, -1}, 1e-15);
  expect_near(mindlin_force({5, 0, -1}, 2, 1, 100, {2, 0, 0}, .01), {.5, 0, -.5}, 1e-15);
}

TEST(Tangential, MindlinSpringGivesNoEnergyOnAClosedPath) {
  // Out by X where the contact is wide (S = 2), back where it is narrow (S = 1): put in S_wide X^2/2 = 1, given back
  // S_narrow X^2/2 = 0.5; were the force kept while the contact shrinks, (S_wide - S_narrow/2) X^2 = 1.5.
  constexpr int steps = 1000;
  const auto given_back = [&](bool falls) {
    Vec3 spring{0, 0, 0};
    double work = 0;
    for (int n = 0; n < steps; ++n) spring = mindlin_force(spring, 2, 2, 2, {1, 0, 0}, 1.0 / steps);
    EXPECT_NEAR(spring.x, -2, 1e-12);
    for (int n = 0; n < steps; ++n) {
      const double before = n == 0 && falls ? 0.5 * spring.x : spring.x;
      spring = mindlin_force(spring, n == 0 && falls ? 2 : 1, 1, 1, {-1, 0, 0}, 1.0 / steps);
      work -= 0.5 * (before + spring.x) / steps;
    }
    return work;
  };
  EXPECT_NEAR(given_back(true), .5, 1e-12);  // the mean of both ends is exact on a straight line
  EXPECT_NEAR(given_back(false), 1.5, 1e-12);
}

TEST(Coulomb, ShareByHand) {
  EXPECT_DOUBLE_EQ(coulomb_share(25, 2), 0.4);
  EXPECT_EQ(coulomb_share(25, 5), 1);  // at the limit nothing changes
  EXPECT_EQ(coulomb_share(25, 6), 1);
  for (double limit : {0.0, -1.0}) EXPECT_EQ(coulomb_share(25, limit), 0);  // a tail that attracts has no friction
  EXPECT_EQ(coulomb_share(0, 0), 0);
}

TEST(Touch, TimeByHand) {
  EXPECT_DOUBLE_EQ(time_since_touch(1e-6, -.5, 1e-5), 2e-6);  // 1 um at 0.5 m/s
  EXPECT_EQ(time_since_touch(1e-5, -.5, 1e-5), 1e-5);         // deeper than one step: all of it
  EXPECT_EQ(time_since_touch(1e-6, .5, 1e-5), 1e-5);
  EXPECT_EQ(time_since_touch(1e-6, 0, 1e-5), 1e-5);
}

TEST(Transport, KeepsTheLengthInTheTangentialPlane) {
  // (3, 0, 4) on the plane of z: along x, of length 5.
  expect_near(transported({3, 0, 4}, {0, 0, 1}), {5, 0, 0}, 1e-15);
  expect_near(transported({0, 0, 4}, {0, 0, 1}), {0, 0, 0}, 0);
  expect_near(transported({0, 0, 0}, {0, 0, 1}), {0, 0, 0}, 0);
}

TEST(Transport, OfAPairTurnedTenTimesKeepsTheLength) {
  // 6283 steps a turn about z, the history in the plane of the turn; each step rounds by 1e-16.
  constexpr int steps = 62832;
  Vec3 xi{0, 3e-6, 0};
  const double length = std::sqrt(dot(xi, xi));
  for (int k = 1; k <= steps; ++k) {
    const double angle = 20 * std::numbers::pi * k / steps;
    xi = transported(xi, {std::cos(angle), std::sin(angle), 0});
  }
  EXPECT_NEAR(std::sqrt(dot(xi, xi)), length, 1e-10 * length);
  expect_near(xi, {0, 3e-6, 0}, 1e-10 * length);  // and comes home
}

}  // namespace
}  // namespace polybed::closures
