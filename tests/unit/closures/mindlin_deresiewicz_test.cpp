// Law with partial slip against its closed forms at constant normal force, and the cube root it stands on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "closures/mindlin_deresiewicz.hpp"

namespace polybed::closures {
namespace {

TEST(CubeRoot, OfShares) {
  // Against long double, as std::cbrt of glibc errs by 6e-16; one unit in the last place is up to 2.2e-16.
  double largest = 0;
  for (double x = 1.3e-29; x <= 1; x *= 1.001) {
    const long double root = std::cbrt(static_cast<long double>(x));
    largest = std::max(largest, static_cast<double>(std::abs((cube_root_of_share(x) - root) / root)));
  }
  EXPECT_LT(largest, 2.2e-16);
  EXPECT_EQ(cube_root_of_share(1), 1);
  EXPECT_EQ(cube_root_of_share(.125), .5);
  EXPECT_NEAR(cube_root_of_share(1e-40), 0, 1e-10);
  EXPECT_EQ(cube_root_of_share(0), 0);
  EXPECT_EQ(cube_root_of_share(-.5), 0);  // slides
  EXPECT_EQ(cube_root_of_share(1.5), 1);
}

constexpr double stiffness = 4e5, friction = .3, normal = 20, limit = friction * normal;
constexpr double xi_m = 1.5 * limit / stiffness;  // 3 mu F_n/(16 G* a), where it slides as a whole

MindlinDeresiewicz moved(MindlinDeresiewicz state, double displacement, int steps, double* work = nullptr) {
  for (int n = 0; n < steps; ++n) {
    const double before = state.force;
    state = mindlin_deresiewicz(state, {stiffness, displacement / steps, friction, normal, 0});
    if (work) *work += 0.5 * (before + state.force) * displacement / steps;
  }
  return state;
}

double loading(double xi) { return limit * (1 - std::pow(1 - xi / xi_m, 1.5)); }
double unloading(double peak, double xi) {
  return loading(peak) - 2 * limit * (1 - std::pow(1 - (peak - xi) / (2 * xi_m), 1.5));
}

/// Largest error over mu F_n on the way up to 0.8 xi_m, back to -0.8 xi_m and up again, N steps each way.
double error_of_cycle(int steps) {
  const double peak = .8 * xi_m;
  double largest = 0;
  MindlinDeresiewicz state;
  for (int quarter = 1; quarter <= 8; ++quarter) {
    state = moved(state, peak / 8, steps / 8);
    largest = std::max(largest, std::abs(state.force - loading(peak * quarter / 8)));
  }
  for (int part = 1; part <= 8; ++part) {
    state = moved(state, -peak / 4, steps / 8);
    largest = std::max(largest, std::abs(state.force - unloading(peak, peak * (1 - part / 4.0))));
  }
  for (int part = 1; part <= 8; ++part) {
    state = moved(state, peak / 4, steps / 8);
    largest = std::max(largest, std::abs(state.force + unloading(peak, peak * (1 - part / 4.0))));
  }
  return largest / limit;
}

TEST(MindlinDeresiewicz, LoadsUnloadsAndReloadsOnTheClosedForms) {
  // An explicit step is first order: error 0.2/N of mu F_n, halved by twice the steps.
  const double coarse = error_of_cycle(400), fine = error_of_cycle(800);
  EXPECT_LT(fine, 5e-4);
  EXPECT_NEAR(coarse / fine, 2, .1);
}

TEST(MindlinDeresiewicz, LosesInACycleWhatTheClosedFormSays) {
  for (double share : {.3, .8}) {
    const double peak = share * xi_m, t = loading(peak) / limit;
    MindlinDeresiewicz state = moved({}, peak, 4000);
    double loss = 0;
    state = moved(state, -2 * peak, 8000, &loss);
    state = moved(state, 2 * peak, 8000, &loss);
    const double root = std::cbrt((1 - t) * (1 - t));
    const double expected = 24.0 / 5 * limit * xi_m * (1 - root * (1 - t) - 5 * t / 6 * (1 + root));
    EXPECT_NEAR(loss, expected, 2e-3 * expected) << share;  // first order in 1/8000, of a difference of large terms
    EXPECT_NEAR(state.force, loading(peak), 1e-3 * limit);  // the loop closes
  }
}

TEST(MindlinDeresiewicz, IsTheSameToBothSides) {
  MindlinDeresiewicz right, left;
  for (double move : {.5, -.9, .3, -.6, 2.0}) {
    right = moved(right, move * xi_m, 100);
    left = moved(left, -move * xi_m, 100);
    EXPECT_EQ(right.force, -left.force);
  }
  EXPECT_EQ(right.force, limit);  // slides in the end
}

TEST(MindlinDeresiewicz, UnloadingPastTheMirrorOfItsReversalIsLoadingTheOtherWay) {
  MindlinDeresiewicz state = moved({}, .4 * xi_m, 4000);
  state = moved(state, -1.2 * xi_m, 12000);
  EXPECT_NEAR(state.force, -loading(.8 * xi_m), 1e-3 * limit);  // first order in 1/4000
  EXPECT_EQ(state.branch, 0);
  EXPECT_EQ(state.side, -1);
}

TEST(MindlinDeresiewicz, ReloadingUpToItsReversalIsLoadingAgain) {
  // Unloads by less than the full loop, then beyond the peak: back on the first curve.
  MindlinDeresiewicz state = moved({}, .5 * xi_m, 5000);
  state = moved(state, -.2 * xi_m, 2000);
  state = moved(state, .45 * xi_m, 4500);
  EXPECT_EQ(state.branch, 0);
  EXPECT_NEAR(state.force, loading(.75 * xi_m), 2e-3 * limit);  // first order in 1/5000
}

TEST(MindlinDeresiewicz, SticksWhileTheNormalForceGrowsFaster) {
  // 8 G* a |dxi| = 1 N below mu dF_n = 1.5 N: theta = 1; then by hand with dF_n = 1 N, F 1 N, mu F_n 6 N:
  // theta = (1 - 1.3/6)^(1/3) = 0.92186577, dF = theta 1 + 0.3 (1 - theta).
  MindlinDeresiewicz state = mindlin_deresiewicz({}, {stiffness, 1 / stiffness, friction, normal, 5});
  EXPECT_NEAR(state.force, 1, 1e-15);
  state = mindlin_deresiewicz(state, {stiffness, 1 / stiffness, friction, normal, 1});
  const double theta = std::cbrt(1 - 1.3 / 6);
  EXPECT_NEAR(state.force, 1 + theta + .3 * (1 - theta), 1e-14);
}

TEST(MindlinDeresiewicz, NeverExceedsFriction) {
  MindlinDeresiewicz state = moved({}, .9 * xi_m, 100);
  for (double force = normal; force >= 0; force -= 1) {
    state = mindlin_deresiewicz(state, {stiffness, 1e-7, friction, force, -1});
    EXPECT_LE(std::abs(state.force), friction * force);
  }
  EXPECT_EQ(state.force, 0);
  EXPECT_EQ(mindlin_deresiewicz({}, {stiffness, 1e-6, 0, normal, 0}).force, 0);  // no friction
}

}  // namespace
}  // namespace polybed::closures
