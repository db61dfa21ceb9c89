// The search for the inversion velocity on functions whose zero is known.
#include <gmock/gmock.h>

#include <cmath>

#include "multiscale/inversion/scan_report.hpp"

namespace polybed::multiscale {
namespace {

/// Runs that answer with a function of the velocity, each with the same interval.
RunAt answers(const std::function<double(double)>& g, double error) {
  return [g, error](double u, const auto&) { return ScanMean{g(u), error}; };
}

TEST(InversionScan, FindsAKnownZeroAndCountsItsRuns) {
  int runs = 0;
  // tanh has its zero at 30 mm/s; what the secant errs by within a bracket of 3 % is far below its width
  const ScanResult found = scan_inversion({0.02, 0.045}, [&](double u, const auto&) {
    ++runs;
    return ScanMean{0.4 * std::tanh((0.030 - u) / 0.004), 1e-4};
  });
  EXPECT_EQ(found.end, ScanEnd::bracket);
  ASSERT_TRUE(found.velocity);
  EXPECT_NEAR(*found.velocity, 0.030, 1e-4);
  EXPECT_LE(found.width(), scan_width);
  EXPECT_LT(found.low, 0.030);
  EXPECT_GT(found.high, 0.030);
  // 2 ends and, each halving the bracket at every second cut at least, 2 log2(0.77/0.03) = 9.4 more
  EXPECT_LE(runs, 12);
  EXPECT_EQ(std::size_t(runs), found.runs.size());
  // of the line between the ends: -0.4/0.004 at the zero, less by the curvature of tanh over a bracket of 0.0009
  EXPECT_NEAR(*found.slope, -100, 2);
  EXPECT_GT(*found.error, 0.5e-4 / 100);  // one of two ends counts at least half
  EXPECT_LT(*found.error, 1e-4 / 98);
}

TEST(InversionScan, EachRunGoesOnFromTheNearerEnd) {
  const ScanResult found = scan_inversion({1, 2}, answers([](double u) { return u * u - 2; }, 1e-9));
  ASSERT_GT(found.runs.size(), 4u);  // the secant of a parabola is not its zero, so there are cuts
  EXPECT_FALSE(found.runs[0].from);
  EXPECT_THAT(found.runs[1].from, testing::Optional(0u));
  for (std::size_t n = 2; n < found.runs.size(); ++n) {
    double nearest = 10;
    for (std::size_t m = 0; m < n; ++m)
      nearest = std::min(nearest, std::abs(found.runs[m].velocity - found.runs[n].velocity));
    EXPECT_DOUBLE_EQ(std::abs(found.runs[*found.runs[n].from].velocity - found.runs[n].velocity), nearest) << n;
  }
}

TEST(InversionScan, WhatIsNotCertainIsRepeatedFromTheOtherSide) {
  // at the first secant, 1.5, nothing can be told; half-width 0.1
  const ScanResult found = scan_inversion({1, 2}, answers([](double u) { return 1.5 - u; }, 0.1));
  EXPECT_EQ(found.end, ScanEnd::indistinct);
  ASSERT_EQ(found.runs.size(), 4u);
  EXPECT_DOUBLE_EQ(found.runs[2].velocity, 1.5);
  EXPECT_DOUBLE_EQ(found.runs[3].velocity, 1.5);
  EXPECT_THAT(found.runs[2].from, testing::Optional(0u));
  EXPECT_THAT(found.runs[3].from, testing::Optional(1u));
  EXPECT_DOUBLE_EQ(*found.velocity, 1.5);
  EXPECT_DOUBLE_EQ(*found.slope, -1);                    // from (1, 0.5) to (2, -0.5)
  EXPECT_DOUBLE_EQ(*found.error, 0.1 / std::sqrt(2.0));  // two means of the same interval
}

TEST(InversionScan, WhatDependsOnTheSideIsAsUncertainAsTheSidesDiffer) {
  const ScanResult found = scan_inversion({1, 2}, [n = 0](double u, const auto&) mutable {
    const double far = 1.5 - u;
    return ++n < 3 ? ScanMean{far, 0.01} : ScanMean{n == 3 ? 0.005 : -0.205, 0.01};
  });
  EXPECT_EQ(found.end, ScanEnd::indistinct);
  EXPECT_NEAR(*found.error, 0.105, 1e-12);  // (0.005 + 0.205)/2 over a slope of 1
}

TEST(InversionScan, WidensARangeThatDoesNotEncloseTheZero) {
  const ScanResult above = scan_inversion({1, 1.2}, answers([](double u) { return 1.9 - u; }, 1e-6));
  EXPECT_EQ(above.end, ScanEnd::bracket);
  EXPECT_NEAR(*above.velocity, 1.9, 1e-6);
  const ScanResult below = scan_inversion({1, 1.2}, answers([](double u) { return 0.6 - u; }, 1e-6));
  EXPECT_NEAR(*below.velocity, 0.6, 1e-6);
  // an end in the noise is not taken for one side or the other
  const ScanResult noisy = scan_inversion({1, 2}, answers([](double u) { return 2.01 - u; }, 0.02));
  EXPECT_NEAR(*noisy.velocity, 2.01, 0.03);
  EXPECT_GT(noisy.high, 2.01);
}

TEST(InversionScan, SaysThatThereIsNone) {
  const ScanResult found = scan_inversion({1, 2}, answers([](double) { return 0.3; }, 0.01));
  EXPECT_EQ(found.end, ScanEnd::not_found);
  EXPECT_FALSE(found.velocity);
  EXPECT_EQ(found.runs.size(), 8u);  // two ends, each widened in turn, six times in all
}

TEST(InversionScan, TheBandOfATableHoldsAllThreeAnswersOrNone) {
  const auto scan = [](std::optional<double> velocity) {
    ScanOfModel s;
    s.model = "tfm";
    s.result.velocity = velocity;
    return s;
  };
  ScanOfModel whole = scan(0.030);
  EXPECT_FALSE(stress_band(whole)) << "not asked for";
  whole.moved = {scan(0.031), scan(0.0305)};
  ASSERT_TRUE(stress_band(whole));
  EXPECT_EQ(stress_band(whole)->low, 0.030);
  EXPECT_EQ(stress_band(whole)->high, 0.031);
  whole.moved[1].result.velocity.reset();
  EXPECT_FALSE(stress_band(whole));
}

TEST(InversionScan, TheModelsAgreeWithinFivePercentOrTheirBrackets) {
  const auto scan = [](const std::string& model, double velocity, double error, double low, double high) {
    ScanOfModel found{model, {}, {}, {}};
    found.result.end = ScanEnd::bracket;
    found.result.velocity = velocity;
    found.result.error = error;
    found.result.low = low;
    found.result.high = high;
    return found;
  };
  const auto close =
      agreement_of({scan("tfm", 34.4e-3, 0.3e-3, 34e-3, 35e-3), scan("dem", 32e-3, 0, 31.7e-3, 32.3e-3)});
  ASSERT_TRUE(close);
  EXPECT_NEAR(close->difference, 0.075, 1e-12);  // 34.4/32 - 1
  EXPECT_NEAR(close->error, 1.075 * 0.3 / 34.4, 1e-12);
  EXPECT_DOUBLE_EQ(close->goal, 0.05);  // brackets of 2.9 and 1.9 %
  const auto wide = agreement_of({scan("tfm", 1, 0, 0.95, 1.05), scan("dem", 1.05, 0, 1, 1.1)});
  EXPECT_NEAR(wide->goal, 0.5 * (0.1 + 0.1 / 1.05), 1e-12);
  // a wide bracket that ended in the noise leaves no more room than its interval
  ScanOfModel noisy = scan("dem", 1.05, 0.03, 0.5, 1.5);
  noisy.result.end = ScanEnd::indistinct;
  EXPECT_NEAR(agreement_of({scan("tfm", 1, 0, 0.95, 1.05), noisy})->goal, 0.5 * (0.1 + 0.06 / 1.05), 1e-12);
  EXPECT_FALSE(agreement_of({scan("tfm", 1, 0, 0.95, 1.05)}));
}

}  // namespace
}  // namespace polybed::multiscale
