// Order in space of the whole system by a manufactured solution: two species, every effect on, all sides joined.
#include <gtest/gtest.h>

#include "scenes/manufactured_box.hpp"
#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

/// Slopes of the fractions and of momentum.
struct Form {
  tfm::Scheme flux, momentum;
};
constexpr Form with_slopes{tfm::Scheme::limited, tfm::Scheme::limited},
    without{tfm::Scheme::upwind, tfm::Scheme::upwind};

/// The error on grids of n, 2n, 4n cells a side.
std::array<Error, 3> errors(const Regime& regime, int dimensions, int n, const Form& form) {
  std::array<Error, 3> found{};
  for (Error& e : found) {
    const core::Scene scene = all_effects(regime, dimensions, {n, n, dimensions == 3 ? n : 1});
    e = Driven(scene, form.flux, form.momentum).error(regime.time);
    record(fmt::format("fraction, {}", n), e.fraction);
    record(fmt::format("velocity, {}", n), e.velocity);
    n *= 2;
  }
  return found;
}

/// Each halving divides both errors by `factor` at least.
void expect_order(const std::array<Error, 3>& e, double factor) {
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_GT(e[n].fraction / e[n + 1].fraction, factor) << "halving " << n + 1;
    EXPECT_GT(e[n].velocity / e[n + 1].velocity, factor) << "halving " << n + 1;
  }
}

// Factors: 4 and 2 for smooth fields,
// less what the limiter loses at extrema (3.2) and the next term (1.8). Bounds on the middle grid: a fifth above what
// was measured when the test was written.
TEST(Manufactured, SecondOrderInTwoDimensionsWithLimitedSchemes) {
  const auto e = errors(liquid_bed, 2, 32, with_slopes);
  expect_order(e, 3.2);
  EXPECT_LT(e[1].fraction, 4.2e-5);
  EXPECT_LT(e[1].velocity, 8.5e-5);
}

TEST(Manufactured, FirstOrderInTwoDimensionsWithUpwindSchemes) {
  const auto e = errors(liquid_bed, 2, 32, without);
  expect_order(e, 1.8);
  EXPECT_LT(e[1].fraction, 3.2e-4);
  EXPECT_LT(e[1].velocity, 7.2e-4);
}

// The schemes that a case has unless it says otherwise, fractions with slopes and momentum without: of first order.
TEST(Manufactured, FirstOrderInTwoDimensionsWithTheSchemesOfACase) {
  const core::Tfm defaults;
  ASSERT_EQ(defaults.flux, core::FractionFlux::limited);
  expect_order(errors(liquid_bed, 2, 32, {tfm::Scheme::limited, tfm::Scheme::upwind}), 1.8);
}

// The same where every term counts, so that none can hide behind drag. Velocities as above. Fractions have had no time
// to run over their extrema: the ripples of h^2 that limiters leave there are differentiated once, by div U, and the
// factor is short of 3.2 (2.81 and 3.13 when the test was written; 3.99 and 3.97 with the limiters taken out).
void expect_second_order_of_all_terms(const std::array<Error, 3>& e) {
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_GT(e[n].velocity / e[n + 1].velocity, 3.2);
    EXPECT_GT(e[n].fraction / e[n + 1].fraction, 2.7);
  }
  EXPECT_LT(e[1].fraction, 1.3e-5);
  EXPECT_LT(e[1].velocity, 7.5e-6);
}

TEST(Manufactured, SecondOrderWhereAllTermsCount) {
  expect_second_order_of_all_terms(errors(balanced, 2, 32, with_slopes));
}

TEST(Manufactured, FirstOrderWhereAllTermsCount) {
  const auto e = errors(balanced, 2, 32, without);
  expect_order(e, 1.8);
  EXPECT_LT(e[1].velocity, 1.0e-4);
}

TEST(Manufactured, SecondOrderInThreeDimensionsWithLimitedSchemes) {
  expect_order(errors(liquid_bed, 3, 6, with_slopes), 3.2);
}

TEST(Manufactured, FirstOrderInThreeDimensionsWithUpwindSchemes) {
  expect_order(errors(liquid_bed, 3, 6, without), 1.8);
}

}  // namespace
}  // namespace polybed::scenes
