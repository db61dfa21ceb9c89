#include "measures/drift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace polybed::measures {
namespace {

std::vector<double> times(int rows, double step) {
  std::vector<double> t;
  for (int n = 0; n < rows; ++n) t.push_back(n * step);
  return t;
}

TEST(Drift, OfAStraightLineIsItsSlope) {
  const std::vector<double> t = times(101, 0.1);
  std::vector<double> y;
  for (const double x : t) y.push_back(0.2 + 3e-3 * x);
  const auto drift = drift_of(t, y);
  ASSERT_TRUE(drift);
  EXPECT_NEAR(drift->rate, 3e-3, 1e-15);
  EXPECT_NEAR(drift->error, 0, 1e-15);
}

// Ten rows are the ten parts. y = t + s with s = +1, -1, -1, +1, 0, 0, 0, 0, 0, 0 at t = 0 ... 9: by hand sum s = 0,
// sum s t = 0 - 1 - 2 + 3 = 0, so the slope is 1, the residuals are s, and the error 2.306 sqrt(4/8/82.5) = 0.17952.
TEST(Drift, ItsIntervalByHand) {
  const auto drift = drift_of(times(10, 1.0), std::vector<double>{1, 0, 1, 4, 4, 5, 6, 7, 8, 9});
  ASSERT_TRUE(drift);
  EXPECT_NEAR(drift->rate, 1, 1e-14);
  EXPECT_NEAR(drift->error, 2.306 * std::sqrt(0.5 / 82.5), 1e-14);
}

// Noise without drift: the interval of 95 % holds 0 in 95 % of 2000 series, give or take 2 % (four standard errors).
TEST(Drift, ItsIntervalCoversNoDriftInNineteenOfTwenty) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise;
  const std::vector<double> t = times(200, 0.05);
  int covered = 0;
  for (int series = 0; series < 2000; ++series) {
    std::vector<double> y;
    for (std::size_t n = 0; n < t.size(); ++n) y.push_back(noise(random));
    const auto drift = drift_of(t, y);
    covered += std::abs(drift->rate) <= drift->error;
  }
  EXPECT_NEAR(covered / 2000.0, 0.95, 0.02);
}

TEST(Drift, IsNotToldFromTooFewRows) {
  EXPECT_FALSE(drift_of(std::vector<double>{}, std::vector<double>{}));
  EXPECT_FALSE(drift_of(times(9, 1.0), std::vector<double>(9, 0.1)));
  EXPECT_FALSE(drift_of(std::vector<double>(20, 1.0), std::vector<double>(20, 0.1)));
}

/// 40 s of a bed of 0.1 m, a row every 0.1 s; what its centre does in time is given, the time of settling, s, and the
/// height of a cell, m.
template <class Centre>
std::vector<DriftOfMeasure> judged(Centre&& centre, double settling = 0, double cell = 0) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> values;
  for (const double t : times(401, 0.1)) values.push_back(std::optional<double>(centre(t)).value_or(none));
  return drifts_of(times(401, 0.1), {{"bed_height", std::vector(401, 0.1)}, {"centre_fine", values, settling}}, cell);
}

// 1e-3 * 0.1 m/40 s = 2.5 um/s is what matters.
TEST(Drifts, ASlowDriftIsTold) {
  const auto found = judged([](double t) { return 0.05 + 3e-6 * t; });
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(found[0].steady);
  EXPECT_FALSE(found[1].steady);
  EXPECT_EQ(found[1].name, "centre_fine");
  EXPECT_NEAR(found[1].drift.rate, 3e-6, 1e-14);
}

// A twentieth of a cell of 4 mm in another 40 s is 5 um/s.
TEST(Drifts, ADriftFarBelowACellIsSteady) {
  EXPECT_TRUE(judged([](double t) { return 0.05 + 3e-6 * t; }, 0, 4e-3)[1].steady);
  EXPECT_FALSE(judged([](double t) { return 0.05 + 6e-6 * t; }, 0, 4e-3)[1].steady);
}

TEST(Drifts, WhatHasSettledOrOnlySwingsIsSteady) {
  EXPECT_TRUE(judged([](double t) { return 0.05 + 2e-6 * t; })[1].steady) << "too slow to matter";
  EXPECT_TRUE(judged([](double t) { return 0.05 - 0.02 * std::exp(-t); })[1].steady);
  EXPECT_TRUE(judged([](double t) { return 0.05 + 0.01 * std::sin(2 * std::numbers::pi * t / 0.7); })[1].steady);
  EXPECT_FALSE(judged([](double t) { return 0.05 - 0.02 * std::exp(-t / 20); })[1].steady) << "still settling";
}

// A bed that settles through its height in 1000 s and creeps at 1 % of that speed, 1e-6 m/s: 0.04 mm in another 40 s,
// 1 mm in the time that counts. 0.05 % of it is at rest.
TEST(Drifts, ABedThatCreepsIsNotAtRest) {
  EXPECT_TRUE(judged([](double t) { return 0.05 - 1e-6 * t; })[1].steady);
  EXPECT_FALSE(judged([](double t) { return 0.05 - 1e-6 * t; }, 1000)[1].steady);
  EXPECT_TRUE(judged([](double t) { return 0.05 - 5e-8 * t; }, 1000)[1].steady);
}

TEST(Drifts, ASpeciesThatIsAbsentIsNotJudged) {
  EXPECT_EQ(judged([](double t) { return t > 35 ? std::nullopt : std::optional(0.05); }).size(), 1u);
  EXPECT_TRUE(drifts_of({}, {}, 0).empty());
}

}  // namespace
}  // namespace polybed::measures
