#include "multiscale/cost/timing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

namespace polybed::multiscale {
namespace {

using ::testing::HasSubstr;

TEST(Timing, MedianAndSpreadByHand) {
  const Timing t = timing_of(std::vector<double>{5, 1, 2, 4, 3});
  EXPECT_EQ(t.median, 3);
  EXPECT_EQ(t.deviation, 1);  // of 2, 2, 1, 1, 0
  EXPECT_EQ(t.quartiles, 2);  // 4 less 2
  EXPECT_EQ(timing_of(std::vector<double>{1, 2}).median, 1.5);
  EXPECT_THROW((void)timing_of({}), std::invalid_argument);
}

// K6 of the specification: noise of 30 % either way, evenly spread over five times, spans 30 % between the quartiles.
TEST(Timing, NoiseIsToldAndNotRanked) {
  const Timing noisy = timing_of(std::vector<double>{0.7, 0.85, 1.0, 1.15, 1.3});
  ASSERT_TRUE(too_noisy(noisy, 1, 2));
  EXPECT_THAT(*too_noisy(noisy, 1, 2), HasSubstr("machine busy"));
  const Timing calm = timing_of(std::vector<double>{0.98, 0.99, 1.0, 1.01, 1.02});
  EXPECT_FALSE(too_noisy(calm, 1, 2));
  EXPECT_THAT(*too_noisy(calm, 2.5, 2), HasSubstr("load 2.5 on 2 cores"));
}

using State = std::array<double, 3>;

/// First component of a system in time, by the classical method of Runge and Kutta, from a start moved by `push`.
std::vector<double> course(const std::function<State(const State&)>& rate, State y, double push, double dt, int steps) {
  const auto moved = [](State y, const State& k, double by) {
    for (std::size_t i = 0; i < 3; ++i) y[i] += by * k[i];
    return y;
  };
  y[0] += push;
  std::vector<double> found;
  for (int n = 0; n < steps; ++n) {
    const State a = rate(y), b = rate(moved(y, a, dt / 2)), c = rate(moved(y, b, dt / 2)), d = rate(moved(y, c, dt));
    for (std::size_t i = 0; i < 3; ++i) y[i] += dt / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    found.push_back(y[0]);
  }
  return found;
}

// K7 of the specification.
TEST(TwinTest, TellsChaosFromAnOscillationThatDies) {
  const auto lorenz = [](const State& y) {
    return State{10 * (y[1] - y[0]), y[0] * (28 - y[2]) - y[1], y[0] * y[1] - 8.0 / 3 * y[2]};
  };
  const auto damped = [](const State& y) { return State{y[1], -y[0] - 0.2 * y[1], 0}; };
  const State start{1, 1, 1};
  EXPECT_TRUE(is_chaotic(course(lorenz, start, 0, 0.01, 5000), course(lorenz, start, 1e-10, 0.01, 5000)));
  EXPECT_FALSE(is_chaotic(course(damped, start, 0, 0.01, 5000), course(damped, start, 1e-10, 0.01, 5000)));
  EXPECT_FALSE(is_chaotic(std::vector<double>(9, 1.0), std::vector<double>(9, 1.0 + 1e-15)));
}

}  // namespace
}  // namespace polybed::multiscale
