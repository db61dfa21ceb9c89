#include "measures/time_mean.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/numerics/random.hpp"

namespace polybed::measures {
namespace {

/// x_k = rho x_k-1 + noise, of variance 1 and mean 0; its autocorrelation time is (1 + rho) / (1 - rho).
std::vector<double> autoregressive(std::uint64_t rows, double rho) {
  std::vector<double> x{core::normal(2, 0, 0)};
  for (std::uint64_t k = 1; k < rows; ++k)
    x.push_back(rho * x.back() + std::sqrt(1 - rho * rho) * core::normal(2, 0, k));
  return x;
}

std::vector<double> line(std::size_t rows) {
  std::vector<double> x;
  for (std::size_t k = 0; k < rows; ++k) x.push_back(double(k));
  return x;
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// 2 sigma: tau sqrt(2 (2 x 47 + 1) / n), Sokal 1997
TEST(TimeMean, AutocorrelationTimeOfAnAutoregressiveSeries) {
  EXPECT_NEAR(autocorrelation_time(autoregressive(200000, 0.9)), 19, 1.2);
  EXPECT_NEAR(autocorrelation_time(autoregressive(200000, 0)), 1, 0.03);
}

// 10 batches of two rows of a straight line: means 0.5, 2.5 ... 18.5, their variance 4 x 55/6; its correlation makes
// the interval wider. Of rows that alternate all batches have the mean 0.5, so the variance of the rows decides.
TEST(TimeMean, ByHand) {
  const TimeMean mean = time_mean(line(20)).value();
  EXPECT_EQ(mean.mean, 9.5);
  EXPECT_GE(mean.interval.value(), 2.262 * std::sqrt(4 * 55.0 / 6 / 10));
  std::vector<double> alternating;
  for (int k = 0; k < 20; ++k) alternating.push_back(k % 2);
  EXPECT_NEAR(time_mean(alternating)->interval.value(), 2.093 * std::sqrt(5.0 / 19 / 20), 1e-12);
}

TEST(TimeMean, OfWhatDoesNotFluctuateAndOfTooLittle) {
  const TimeMean still = time_mean(std::vector<double>(100, 0.1)).value();
  EXPECT_EQ(still.mean, 0.1);
  EXPECT_EQ(still.interval, 0);
  EXPECT_FALSE(time_mean(std::vector<double>(19, 1.0))->interval);
  EXPECT_FALSE(time_mean({}));
  EXPECT_FALSE(time_mean(std::vector{1.0, nan}));
}

// Of 15 degrees of freedom that of 10; 2.131 in tables.
TEST(TimeMean, StudentsQuantileIsNeverTooSmall) {
  EXPECT_EQ(student_quantile(9), 2.262);
  EXPECT_EQ(student_quantile(15), 2.228);
  EXPECT_EQ(student_quantile(1000), 2.093);
  EXPECT_THROW((void)student_quantile(2), std::invalid_argument);
}

// After 60 rows the transient is 1, one standard deviation; after 100 it is over.
TEST(TimeMean, TheRuleDropsATransient) {
  std::vector<double> x = autoregressive(400, 0);
  for (std::size_t k = 0; k < 100; ++k) x[k] += 20 * std::exp(-double(k) / 20);
  EXPECT_GT(rows_to_drop(x), 50u);
  EXPECT_LE(rows_to_drop(x), 110u);
  EXPECT_EQ(rows_to_drop(line(100)), 50u);  // never more than half
  EXPECT_EQ(rows_to_drop(std::vector<double>(100, 0.1)), 0u);
  EXPECT_EQ(rows_to_drop(std::vector<double>{1, nan, 1, 1, 1}), 0u);
}

// The sum of squares of 1 4 2 8 5 7 about their mean 4.5 is 37.5.
TEST(TimeMean, TheJackknifeOfAMeanIsTheVarianceOfTheMean) {
  const std::vector<double> x{1, 4, 2, 8, 5, 7};
  std::vector<Value> means;
  for (const Rows& group : groups_of(x.size())) means.push_back(mean_of(without(x, group)));
  EXPECT_NEAR(jackknife_interval(means).value(), 2.571 * std::sqrt(37.5 / 5 / 6), 1e-14);
  EXPECT_NEAR(interval_of_repeats(x).value(), 2.571 * std::sqrt(37.5 / 5 / 6), 1e-14);
  EXPECT_TRUE(groups_of(3).empty());
  EXPECT_FALSE(jackknife_interval(std::vector<Value>{1, 2, 3}));
  EXPECT_FALSE(jackknife_interval(std::vector<Value>{1, 2, {}, 4}));
  std::size_t end = 0;
  for (const Rows& group : groups_of(23)) {  // ten groups of two or three rows, each row in one of them
    EXPECT_EQ(group.begin, end);
    EXPECT_EQ(group.count() / 2, 1u);
    end = group.end;
  }
  EXPECT_EQ(groups_of(23).size(), 10u);
  EXPECT_EQ(end, 23u);
}

}  // namespace
}  // namespace polybed::measures
