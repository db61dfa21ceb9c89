#include "multiscale/cost/fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace polybed::multiscale {
namespace {

using ::testing::ElementsAre;

TEST(PowerLaw, FoundFromItsPoints) {
  const std::vector<double> x{1, 2, 4, -1}, y{3, 12, 48, 7};  // 3 x^2; what has no logarithm does not count
  const auto law = fit_power_law(x, y);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->factor, 3, 1e-12);
  EXPECT_NEAR(law->exponent, 2, 1e-12);
  EXPECT_NEAR(law->scatter, 0, 1e-12);
  EXPECT_NEAR(law->at(3), 27, 1e-10);
  EXPECT_FALSE(fit_power_law(std::vector<double>{2, 2}, std::vector<double>{1, 3}));
  // ln y = 0, 1, 0 at ln x = 0, 1, 2: slope 0, mean 1/3, residuals -1/3, 2/3, -1/3 with mean square 6/27.
  const std::vector<double> a{1, std::exp(1), std::exp(2)}, b{1, std::exp(1), 1};
  EXPECT_NEAR(fit_power_law(a, b)->scatter, std::sqrt(6.0 / 27), 1e-12);
}

TEST(ParetoFront, HoldsWhatNothingBeats) {
  const std::vector<Priced> points{{1, 1}, {0.5, 2}, {0.7, 3}, {0.5, 2}, {0.1, 10}, {2, 0.5}};
  EXPECT_THAT(pareto_front(points), ElementsAre(5, 0, 1, 4));
}

/// Error h^2 and 1/sqrt(T), cost T h^-3, by hand: with the share s for space, T = 1/((1 - s) E^2) and h = s^(1/4)
/// sqrt(E), so the cost goes with s^(-3/4)/(1 - s), least at s = 3/7: "same grid, longer" instead of a finer one.
TEST(Cheapest, SharesTheErrorBetweenGridAndWindow) {
  ErrorModel model;
  model.space = {1, 2, 0};
  model.fluctuation = 1;
  model.rate = 1;
  model.space_exponent = 3;
  const Optimum found = cheapest(model, 0.1);
  EXPECT_NEAR(found.window, 100 / (1 - 3.0 / 7), 1);  // 175 s; flat about the optimum
  EXPECT_NEAR(found.spacing, std::sqrt(0.1 * std::sqrt(3.0 / 7)), 1e-3);
}

}  // namespace
}  // namespace polybed::multiscale
