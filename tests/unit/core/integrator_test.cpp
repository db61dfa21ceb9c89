#include "core/numerics/integrator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "core/error.hpp"

namespace polybed::core {
namespace {

/// y' = f(t, y) from a function.
class Ode : public OdeProblem {
 public:
  using Function = std::function<Rate(double, std::span<const double>, std::span<double>)>;
  explicit Ode(Function f) : f_(std::move(f)) {}
  Rate rates(double t, std::span<const double> y, std::span<double> dydt) override {
    ++evaluations;
    return f_(t, y, dydt);
  }
  int evaluations = 0;

 private:
  Function f_;
};

/// Two bodies on a circle: y = (cos t, sin t).
Ode circle() {
  return Ode([](double, std::span<const double> y, std::span<double> f) {
    f[0] = -y[1];
    f[1] = y[0];
    return Rate::ok;
  });
}

double run(Integrator& integrator, double until) {
  integrator.restart(0, std::vector<double>{1.0, 0.0}, {}, 0);
  for (double t = 0; t < until;) t = integrator.step(until).time;
  return std::hypot(integrator.state()[0] - std::cos(until), integrator.state()[1] - std::sin(until));
}

// Bogacki and Shampine's method is of order 3: halving the step divides the error by 8; 0.15 in the exponent
// covers the next term of the series at these steps.
TEST(Explicit, IsOfOrderThree) {
  double before = 0;
  for (const double h : {0.1, 0.05, 0.025}) {
    Ode problem = circle();
    const auto integrator = make_explicit(problem, {.rtol = 1e-3, .atol = {1e-6, 1e-6}, .fixed_step = h});
    const double error = run(*integrator, 2.0);
    if (before > 0) {
      EXPECT_NEAR(std::log2(before / error), 3.0, 0.15) << h;
    }
    before = error;
  }
}

// y' = y^2 from 1 has no value beyond t = 1: steps shrink towards it for ever, and the run says so.
TEST(Explicit, SaysThatItStandsStill) {
  Ode problem([](double, std::span<const double> y, std::span<double> f) {
    f[0] = y[0] * y[0];
    return Rate::ok;
  });
  const auto integrator = make_explicit(problem, {.rtol = 1e-4, .atol = {1e-6}});
  integrator->restart(0, std::vector<double>{1.0}, {}, 0);
  const auto go_on = [&] {
    for (double t = 0; t < 2;) t = integrator->step(2).time;
  };
  EXPECT_THAT(go_on, testing::ThrowsMessage<NumericsError>(testing::HasSubstr("stands still")));
  EXPECT_GT(integrator->state()[0], 1e3);
}

// Error control per step: the error at the end follows the tolerance. A hundred times less tolerance must
// give at least ten times less error.
TEST(Explicit, TheErrorFollowsTheTolerance) {
  double before = 0;
  for (const double rtol : {1e-3, 1e-5, 1e-7}) {
    Ode problem = circle();
    const auto integrator = make_explicit(problem, {.rtol = rtol, .atol = {rtol, rtol}});
    const double error = run(*integrator, 5.0);
    EXPECT_LT(error, 30 * rtol);
    if (before > 0) {
      EXPECT_LT(error, before / 10);
    }
    before = error;
  }
}

TEST(Explicit, LandsOnTheTimeToTheBitAndInterpolatesWithin) {
  Ode problem = circle();
  const auto integrator = make_explicit(problem, {.rtol = 1e-6, .atol = {1e-9, 1e-9}});
  integrator->restart(0, std::vector<double>{1.0, 0.0}, {}, 0);
  double before = 0, t = 0;
  while (t < 0.1) {
    before = t;
    t = integrator->step(0.1).time;
  }
  EXPECT_EQ(t, 0.1);
  std::vector<double> y(2);
  const double middle = 0.5 * (before + t);
  integrator->interpolate(middle, y);
  EXPECT_NEAR(y[0], std::cos(middle), 1e-6);  // third-order Hermite between two points of error below rtol
}

// Where a state cannot be evaluated the step shrinks and the run goes on; here y > 1 is forbidden, and y' = 1
// - y from 0 never gets there, but a long first step would.
TEST(Explicit, ARecoverableErrorShrinksTheStep) {
  Ode problem([](double, std::span<const double> y, std::span<double> f) {
    f[0] = 1 - y[0];
    return y[0] > 1 ? Rate::recoverable : Rate::ok;
  });
  const auto integrator = make_explicit(problem, {.rtol = 1e-4, .atol = {1e-8}});
  integrator->restart(0, std::vector<double>{0.0}, {}, 50.0);
  double t = 0;
  while (t < 2) t = integrator->step(2).time;
  EXPECT_NEAR(integrator->state()[0], 1 - std::exp(-2.0), 1e-3);
  EXPECT_GT(integrator->statistics().recoverable_failures, 0U);
}

TEST(Explicit, AStateThatNeverEvaluatesEndsWithTheReason) {
  Ode problem([](double, std::span<const double>, std::span<double>) { return Rate::recoverable; });
  const auto integrator = make_explicit(problem, {.rtol = 1e-4, .atol = {1e-8}});
  integrator->restart(0, std::vector<double>{0.0}, {}, 1e-3);
  EXPECT_THROW(integrator->step(1), NumericsError);
}

TEST(Explicit, AnExceptionPassesThrough) {
  Ode problem([](double t, std::span<const double>, std::span<double> f) {
    if (t > 0.5) throw std::runtime_error("from inside");
    f[0] = 1;
    return Rate::ok;
  });
  const auto integrator = make_explicit(problem, {.rtol = 1e-4, .atol = {1e-8}});
  integrator->restart(0, std::vector<double>{0.0}, {}, 0.1);
  EXPECT_THROW(while (true) integrator->step(1), std::runtime_error);
}

TEST(Explicit, WhatFollowsARestartDependsOnItsArgumentsAlone) {
  Ode problem = circle();
  const ExplicitOptions options{.rtol = 1e-5, .atol = {1e-8, 1e-8}};
  const auto used = make_explicit(problem, options), fresh = make_explicit(problem, options);
  (void)run(*used, 3.0);
  const std::vector<double> y{0.3, -0.7};
  used->restart(1.5, y, {}, 0.01);
  fresh->restart(1.5, y, {}, 0.01);
  for (double t = 1.5; t < 4;) {
    const StepReport a = used->step(4), b = fresh->step(4);
    ASSERT_EQ(a.time, b.time);
    ASSERT_EQ(used->state()[0], fresh->state()[0]);
    t = a.time;
  }
}

// y' = -100 y, with steps that stability bounds: within a tolerance that stays y wanders for ever, with one that
// follows |y| it dies out. e^-1000 is nothing; 1e-9 is what the tolerance that follows is bounded by.
TEST(Explicit, ToleranceThatFollowsTheStateLetsItComeToRest) {
  Ode problem([](double, std::span<const double> y, std::span<double> f) {
    f[0] = -100 * y[0];
    return Rate::ok;
  });
  ExplicitOptions options{.rtol = 1e-6, .atol = {1e-4}};
  const auto left = [&] {
    const auto integrator = make_explicit(problem, options);
    integrator->restart(0, std::vector<double>{1.0}, {}, 0);
    double most = 0;
    for (double t = 0; t < 10;) {
      t = integrator->step(10).time;
      if (t > 5) most = std::max(most, std::abs(integrator->state()[0]));
    }
    return most;
  };
  EXPECT_GT(left(), 1e-7);
  options.atol_at = [](std::span<const double> y, std::span<const double> dydt, std::span<double> atol) {
    EXPECT_TRUE(dydt.empty());
    atol[0] = 1e-4 * std::clamp(std::abs(y[0]), 1e-8, 1.0);
  };
  EXPECT_LT(left(), 1e-9);
}

// y' = -y, whose residual fails wherever the linear solver asks for it.
class NoDerivative : public DaeProblem {
 public:
  Rate residual(double t, std::span<const double> y, std::span<const double> dydt, std::span<double> r) override {
    const bool in_linear_solve = t == preconditioned_at_;
    r[0] = dydt[0] + y[0];
    return in_linear_solve ? Rate::recoverable : Rate::ok;
  }
  Rate setup(double, std::span<const double>, std::span<const double>, std::span<const double>, double) override {
    return Rate::ok;
  }
  Rate precondition(double t, std::span<const double> r, std::span<double> z, double, double) override {
    preconditioned_at_ = t;
    z[0] = r[0];
    return Rate::ok;
  }

 private:
  double preconditioned_at_ = -1;
};

// Its steps shrink until they need no linear solve; a guess is not taken for a solution.
TEST(Implicit, ShrinksItsStepsWhereNoDerivativeCanBeTaken) {
  NoDerivative problem;
  const auto integrator = make_implicit(problem, {.rtol = 1e-5, .atol = {1e-7}, .id = {1}});
  const std::vector<double> y{1}, dydt{-1};
  integrator->restart(0, y, dydt, 0.1);
  // A guess left as it is must lie within a small share of the tolerance of 1e-5: h^2/2 of a first step.
  EXPECT_LT(integrator->step(1).step, 1e-3);
}

/// A particle in a flow: u' = -k (u - v), which is fast, and v' = -sin t. From v(0) = 1 v = cos t, and
/// u = (k^2 cos t + k sin t)/(k^2 + 1) if it begins there.
class Carried : public SplitProblem {
 public:
  Rate rates(double t, std::span<const double> y, std::span<double> dydt) override {
    ++evaluations;
    dydt[0] = -k * (y[0] - y[1]);
    dydt[1] = -std::sin(t);
    return Rate::ok;
  }
  void hold() override { ++holds; }
  [[nodiscard]] double longest_step() const override { return longest; }
  void add_fast(double factor, std::span<const double> y, std::span<double> rates) override {
    rates[0] -= factor * k * (y[0] - y[1]);
  }
  void solve_fast(double gamma, std::span<double> x) override { x[0] = (x[0] + gamma * k * x[1]) / (1 + gamma * k); }
  [[nodiscard]] double exact(double t) const { return (k * k * std::cos(t) + k * std::sin(t)) / (k * k + 1); }
  /// Distance from the solution at t = 1, after fixed steps if there are any.
  double error(double fixed_step, double rtol = 1e-6) {
    ExplicitOptions options{rtol, {rtol, rtol}};
    options.fixed_step = fixed_step;
    const auto integrator = make_split(*this, std::move(options));
    integrator->restart(0, std::vector<double>{exact(0), 1.0}, {}, 0);
    double t = 0;
    while (t < 1) t = integrator->step(1).time;
    done = integrator->statistics();
    return std::abs(integrator->state()[0] - exact(1));
  }
  double k = 1e4, longest = 1e9;
  int evaluations = 0, holds = 0;
  IntegratorStatistics done;
};

// The time is 1e4 relaxation times: explicit steps would need 4000. The error is that of the tolerance, and each try
// asks for the rates four times, each step for the coefficients once.
TEST(Integrator, TheSplitOneStepsOverAFastPart) {
  Carried problem;
  EXPECT_LT(problem.error(0), 1e-5);
  EXPECT_LT(problem.done.steps, 200u);
  EXPECT_EQ(problem.holds, int(problem.done.steps));
  EXPECT_LE(problem.evaluations, 4 * int(problem.done.steps + problem.done.error_failures) + 4);
}

TEST(Integrator, TheSplitOneKeepsWithinTheLongestStep) {
  Carried problem;
  problem.longest = 2e-3;
  EXPECT_LT(problem.error(0), 1e-5);
  EXPECT_GE(problem.done.steps, 500u);
  EXPECT_LT(problem.done.steps, 520u);
}

// Halving the step divides the error by 8 where the fast part is resolved.
TEST(Integrator, TheSplitOneIsOfThirdOrder) {
  Carried problem;
  problem.k = 1;
  EXPECT_NEAR(std::log2(problem.error(0.05) / problem.error(0.025)), 3, 0.2);
}

}  // namespace
}  // namespace polybed::core
