#include "multiscale/cost/timing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

// Chaos itself is K7 of the selftest.
TEST(TwinTest, WhatStandsStillIsSteady) {
  EXPECT_FALSE(is_chaotic(std::vector<double>(9, 1.0), std::vector<double>(9, 1.0 + 1e-15)));
}

}  // namespace
}  // namespace polybed::multiscale
