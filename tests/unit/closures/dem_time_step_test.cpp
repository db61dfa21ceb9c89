// Rayleigh time by hand, and the limits of both schemes found by integration.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "closures/contact_pair.hpp"
#include "closures/dem_time_step.hpp"

namespace polybed::closures {
namespace {

TEST(TimeStep, RayleighTime) {
  // Four printed digits, by hand.
  EXPECT_NEAR(rayleigh_time(9.5e-3 / 2, 7780, shear_modulus({200e9, .33}), .33), 5.159e-6, 5e-10);
  EXPECT_NEAR(rayleigh_time(.5e-3, 2500, shear_modulus({50e9, .25}), .25), 6.054e-7, 5e-11);
}

TEST(TimeStep, DenseSprings) { EXPECT_DOUBLE_EQ(dense_spring_step(1e-6, 1e4), .17e-5); }

/// True if one damped spring of mass and stiffness 1 stays bounded at this step; it has 4000 steps to grow in.
bool bounded(double dt, double zeta, bool synchronised) {
  double x = 1, u = 0, force = -1;
  for (int n = 0; n < 4000; ++n) {
    const double half = u + 0.5 * dt * force;
    x += dt * half;
    force = -x - 2 * zeta * (synchronised ? half + 0.5 * dt * force : half);
    u = half + 0.5 * dt * force;
    if (std::abs(x) > 1e6) return false;
  }
  return true;
}

double measured_limit(double zeta, bool synchronised) {
  double low = 0, high = 4;
  while (high - low > 1e-4) (bounded(0.5 * (low + high), zeta, synchronised) ? low : high) = 0.5 * (low + high);
  return low;
}

struct Limit {
  double zeta, thesis, synchronised;
};

class StepLimit : public testing::TestWithParam<Limit> {};

TEST_P(StepLimit, IsTheMeasuredOne) {
  const Limit& row = GetParam();
  // The table was measured and printed with two decimals: one unit of the last.
  EXPECT_NEAR(step_limit_thesis(1, row.zeta), row.thesis, .01);
  EXPECT_NEAR(step_limit_synchronised(1, row.zeta), row.synchronised, .01);
  EXPECT_DOUBLE_EQ(step_limit_thesis(50, row.zeta), step_limit_thesis(1, row.zeta) / 50);
  // 4000 steps to grow 1e6-fold tell a growth of 3.5e-3 per step.
  const double thesis = step_limit_thesis(1, row.zeta), synchronised = step_limit_synchronised(1, row.zeta);
  EXPECT_NEAR(measured_limit(row.zeta, false), thesis, .01 * thesis);
  EXPECT_NEAR(measured_limit(row.zeta, true), synchronised, .01 * synchronised);
}

INSTANTIATE_TEST_SUITE_P(Table, StepLimit,
                         testing::Values(Limit{0, 2, 2}, Limit{.05, 1.90, 1.81}, Limit{.2, 1.64, 1.36},
                                         Limit{.5, 1.24, .83}, Limit{1, .83, .47}));

}  // namespace
}  // namespace polybed::closures
