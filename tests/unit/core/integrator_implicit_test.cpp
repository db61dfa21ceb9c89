// Backward differences: steps, preconditioner and tolerances of the implicit integrator.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/numerics/integrator.hpp"

namespace polybed::core {
namespace {

/// x' = -k (x - cos t), 0 = z - x^2: stiff, with one algebraic entry; x -> cos t for large k.
class StiffDae : public DaeProblem {
 public:
  double k = 1e6;
  Rate residual(double t, std::span<const double> y, std::span<const double> dydt, std::span<double> r) override {
    r[0] = dydt[0] + k * (y[0] - std::cos(t));
    r[1] = y[1] - y[0] * y[0];
    return Rate::ok;
  }
  Rate setup(double, std::span<const double> y, std::span<const double>, std::span<const double>, double) override {
    x_ = y[0];
    return Rate::ok;
  }
  Rate precondition(double, std::span<const double> r, std::span<double> z, double cj, double) override {
    z[0] = r[0] / (cj + k);
    z[1] = r[1] + 2 * x_ * z[0];
    return Rate::ok;
  }

 private:
  double x_ = 0;
};

// A stiff equation with a smooth solution: as many steps as the solution needs, not as many as 1/k would ask
// for (2e6 steps for an explicit method). The error at the end stays within a few times the tolerance.
TEST(Implicit, StepsOverWhatIsStiff) {
  StiffDae problem;
  const auto integrator = make_implicit(problem, {.rtol = 1e-5, .atol = {1e-7, 1e-7}, .id = {1, 0}});
  const std::vector<double> y{1.0, 1.0}, dydt{0.0, 0.0};
  integrator->restart(0, y, dydt, 1e-6);
  for (double t = 0; t < 2;) t = integrator->step(2).time;
  const double exact = std::cos(2.0);
  EXPECT_NEAR(integrator->state()[0], exact, 3e-4);
  EXPECT_NEAR(integrator->state()[1], exact * exact, 3e-4);
  EXPECT_LT(integrator->statistics().steps, 1000U);
}

/// x_i' = -k_i (x_i - cos t), stiff; the k_i drift apart while steps, which follow the cosine, stay equal.
class DriftingDae : public DaeProblem {
 public:
  static constexpr std::size_t size = 20;
  Rate residual(double t, std::span<const double> y, std::span<const double> dydt, std::span<double> r) override {
    for (std::size_t i = 0; i < size; ++i) r[i] = dydt[i] + stiffness(i, t) * (y[i] - std::cos(t));
    return Rate::ok;
  }
  Rate setup(double t, std::span<const double>, std::span<const double>, std::span<const double>, double) override {
    made_at_ = t;
    return Rate::ok;
  }
  Rate precondition(double, std::span<const double> r, std::span<double> z, double cj, double) override {
    for (std::size_t i = 0; i < size; ++i) z[i] = r[i] / (cj + stiffness(i, made_at_));
    return Rate::ok;
  }

 private:
  static double stiffness(std::size_t i, double t) { return 1e4 * std::exp(3 * std::sin(10 * t + double(i))); }
  double made_at_ = 0;
};

// A new preconditioner is exact here: one iteration; kept while the k_i drift, a solve takes up to one for each.
TEST(Implicit, MakesANewPreconditionerBeforeSolvesGetLong) {
  DriftingDae problem;
  const std::vector<double> y(DriftingDae::size, 1.0), dydt(y.size(), 0.0), atol(y.size(), 1e-7);
  const auto integrator = make_implicit(problem, {.rtol = 1e-5, .atol = atol, .id = y});
  integrator->restart(0, y, dydt, 1e-6);
  for (double t = 0; t < 1;) t = integrator->step(1).time;
  const auto work = integrator->statistics();
  EXPECT_LT(work.linear_iterations, 4 * work.newton_iterations);  // three in excess of one, then a new one
  EXPECT_LT(work.preconditioner_setups, work.newton_iterations);
}

// The weights are asked for at each step with the rates there: at the start those that are given.
TEST(Implicit, ToleranceThatFollowsTheStateGetsItsRates) {
  StiffDae problem;
  std::vector<double> first_rates;
  int asked = 0;
  ImplicitOptions options{.rtol = 1e-4, .atol = {1e-7, 1e-7}, .id = {1, 0}};
  options.atol_at = [&](std::span<const double>, std::span<const double> dydt, std::span<double> atol) {
    if (asked++ == 0) first_rates.assign(dydt.begin(), dydt.end());
    std::fill(atol.begin(), atol.end(), 1e-7);
  };
  const auto follows = make_implicit(problem, options);
  options.atol_at = {};
  const auto stays = make_implicit(problem, options);
  const std::vector<double> y{1.0, 1.0}, dydt{0.0, 0.25};
  follows->restart(0, y, dydt, 1e-6);
  stays->restart(0, y, dydt, 1e-6);
  for (double t = 0; t < 1;) {
    t = follows->step(1).time;
    ASSERT_EQ(t, stays->step(1).time) << "the same tolerances, the same steps";
  }
  EXPECT_EQ(first_rates, dydt);
  EXPECT_GE(asked, int(follows->statistics().steps));
}

// The last digit of this time is 2.4e-7 s. A rate that is off by 1e3 1/s needs first steps of 1e-8 s, which the library
// finds after it has given up with the step of 1 s that it was given.
TEST(Implicit, StartsLateWithARateThatIsOff) {
  StiffDae problem;
  problem.k = 1e9;
  const double begin = 1.2e9;
  const auto integrator = make_implicit(problem, {.rtol = 1e-5, .atol = {1e-7, 1e-7}, .id = {1, 0}});
  const double x = std::cos(begin);
  integrator->restart(begin, std::vector<double>{x, x * x}, std::vector<double>{1e3, 2e3 * x}, 1.0);
  for (double t = begin; t < begin + 1;) t = integrator->step(begin + 1).time;
  EXPECT_NEAR(integrator->state()[0], std::cos(begin + 1), 3e-4);
  std::vector<double> y(2);
  integrator->interpolate(begin + 1, y);
  EXPECT_EQ(y[0], integrator->state()[0]);
}

TEST(Implicit, WhatFollowsARestartDependsOnItsArgumentsAlone) {
  StiffDae problem, other;
  const ImplicitOptions options{.rtol = 1e-4, .atol = {1e-7, 1e-7}, .id = {1, 0}};
  const auto used = make_implicit(problem, options), fresh = make_implicit(other, options);
  const std::vector<double> y{1.0, 1.0}, dydt{0.0, 0.0};
  used->restart(0, y, dydt, 1e-5);
  for (int n = 0; n < 20; ++n) used->step(1);
  used->restart(0, y, dydt, 1e-4);
  fresh->restart(0, y, dydt, 1e-4);
  for (double t = 0; t < 1;) {
    t = used->step(1).time;
    ASSERT_EQ(t, fresh->step(1).time);
    ASSERT_EQ(used->state()[0], fresh->state()[0]);
  }
}

/// x_i' = -k_i (x_i - cos(t/1000 + i)), solved without a preconditioner: a slow solution, so that errors allow long
/// steps, and k_i from 1 to 1e4, so that longer steps need more vectors than the solver has.
class UnpreparedDae : public DaeProblem {
 public:
  static constexpr std::size_t size = 400;
  Rate residual(double t, std::span<const double> y, std::span<const double> dydt, std::span<double> r) override {
    for (std::size_t i = 0; i < size; ++i)
      r[i] = dydt[i] + std::pow(10, 4.0 * double(i) / double(size - 1)) * (y[i] - std::cos(1e-3 * t + double(i)));
    return Rate::ok;
  }
  Rate setup(double, std::span<const double>, std::span<const double>, std::span<const double>, double) override {
    return Rate::ok;
  }
  Rate precondition(double, std::span<const double> r, std::span<double> z, double, double) override {
    std::copy(r.begin(), r.end(), z.begin());
    return Rate::ok;
  }
};

// Doubled until they fail, steps fail 19 times in 61, and solves take 1523 iterations.
TEST(Implicit, DoesNotTryALengthAgainAtOnceThatNewtonFailedOn) {
  UnpreparedDae problem;
  const std::vector<double> ones(UnpreparedDae::size, 1.0), none(ones.size(), 0.0), atol(ones.size(), 1e-4);
  std::vector<double> y;
  for (std::size_t i = 0; i < ones.size(); ++i) y.push_back(std::cos(double(i)));
  const auto integrator = make_implicit(problem, {.rtol = 1e-3, .atol = atol, .id = ones, .krylov_vectors = 30});
  integrator->restart(0, y, none, 1e-6);
  for (double t = 0; t < 10;) t = integrator->step(10).time;
  const auto work = integrator->statistics();
  EXPECT_LT(work.newton_failures, work.steps / 10);
  EXPECT_LT(work.linear_iterations, 1200U);
}

}  // namespace
}  // namespace polybed::core
