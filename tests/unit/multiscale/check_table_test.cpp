// A table of the solids stress held against boxes that it was not fitted to: all by hand, no box is run.
#include "multiscale/calibrate/check_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace polybed::multiscale {
namespace {

using ::testing::HasSubstr;

/// The same ratio and standard error at each Stokes number, of every solids fraction.
fluid::TableQuantity same_for_all(const std::vector<double>& value, double error, std::size_t stokes) {
  fluid::TableQuantity q;
  for (const double v : value)
    for (std::size_t s = 0; s < stokes; ++s) {
      q.value.push_back(v);
      q.error.push_back(error);
      q.seeds.push_back(3);
    }
  return q;
}

/// Solids fractions 0.3 and 0.5, Stokes numbers 1 and 100, lambda 0.05. Half-way between two knots a monotone cubic
/// with flat ends is at their mean: p 0.9 +- 0.09, mu 0.5 +- 0.02.
fluid::SolidsTable wet_table() {
  fluid::SolidsTable t;
  t.regime = "wet";
  t.phi = {0.3, 0.5};
  t.stokes = {1, 100};
  t.restitution = {0.9};
  t.friction = {0.3};
  t.share = {0};
  t.inertia = 0.05;
  t.pressure = same_for_all({0.8, 1.0}, 0.09, 2);
  t.viscosity = same_for_all({0.6, 0.4}, 0.02, 2);
  t.dissipation = t.temperature = same_for_all({1, 1}, 0, 2);
  return t;
}

BoxResult box_at(double phi, double stokes) {
  BoxResult box;
  box.point.regime = "wet";
  box.point.phi = phi;
  box.point.stokes = stokes;
  box.point.restitution = 0.9;
  box.point.friction = 0.3;
  return box;
}

// At St 10 the table says (1 + 0.05 10) 0.9 = 1.35 for p and 0.75 for mu. A box of 1.62 +- 0.162 is 20 % above, with
// 0.162/1.35 = 12 % of its own and 0.09/0.9 = 10 % of the table; one of 0.6 +- 0.0225 is 20 % below, with 3 and 4 %.
TEST(CheckTable, ABoxOverTheTableLessOneWithTheErrorsOfBoth) {
  BoxResult box = box_at(0.4, 10);
  box.pressure_ratio = {1.62, 0.162};
  box.viscosity_ratio = {0.6, 0.0225};
  const Deviation d = deviation(wet_table(), box);
  EXPECT_NEAR(d.pressure, 0.2, 1e-12);
  EXPECT_NEAR(d.pressure_error, std::hypot(0.12, 0.1), 1e-12);
  EXPECT_NEAR(d.viscosity, -0.2, 1e-12);
  EXPECT_NEAR(d.viscosity_error, 0.05, 1e-12);
  EXPECT_EQ(d.point.stokes, 10);
  const std::string lines = deviation_lines({d});
  EXPECT_THAT(lines, HasSubstr("+20.0 % +- 15.6 (1.3 se)"));
  EXPECT_THAT(lines, HasSubstr("-20.0 % +- 5.0 (4.0 se)"));
}

// Between Stokes numbers the ratios run as a line in ln St: at 10, half-way from 1 to 100, 0.9 and 1.1 give 1.
TEST(CheckTable, BetweenStokesNumbersTheTableIsTakenInTheLogarithm) {
  fluid::SolidsTable t = wet_table();
  t.pressure.value = {0.9, 1.1, 0.9, 1.1};
  BoxResult box = box_at(0.35, 10);
  box.pressure_ratio = {1.5, 0};
  box.viscosity_ratio = {1, 0};
  EXPECT_NEAR(deviation(t, box).pressure, 0, 1e-12);
  box.point.stokes = 1;  // 1.5 over (1 + 0.05) 0.9
  EXPECT_NEAR(deviation(t, box).pressure, 1.5 / (1.05 * 0.9) - 1, 1e-12);
}

// A dry table has Stokes number 0 alone and no lambda.
TEST(CheckTable, ADryBoxIsHeldAgainstTheRatioItself) {
  fluid::SolidsTable t = wet_table();
  t.regime = "dry";
  t.stokes = {0};
  t.inertia = 0;
  t.pressure = same_for_all({0.8, 1.0}, 0.045, 1);
  t.viscosity = t.dissipation = t.temperature = same_for_all({1, 1}, 0, 1);
  BoxResult box = box_at(0.4, 0);
  box.pressure_ratio = {0.81, 0};
  box.viscosity_ratio = {1.02, 0.01};
  const Deviation d = deviation(t, box);
  EXPECT_NEAR(d.pressure, -0.1, 1e-12);
  EXPECT_NEAR(d.pressure_error, 0.05, 1e-12);
  EXPECT_NEAR(d.viscosity, 0.02, 1e-12);
  EXPECT_NEAR(d.viscosity_error, 0.01, 1e-12);
}

TEST(CheckTable, PointsAreThoseBetweenTheKnots) {
  fluid::SolidsTable t = wet_table();
  t.phi = {0.1, 0.2, 0.3, 0.4, 0.5, 0.55};
  t.stokes = {1, 10, 40};
  t.restitution = {0.8, 0.9};
  t.friction = {0.1, 0.3};
  t.share = {0.25, 0.75};
  Plan plan;
  plan.binary = true;
  const std::vector<BoxPoint> points = points_between(t, plan);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_NEAR(points[0].phi, 0.15, 1e-15);
  EXPECT_NEAR(points[1].phi, 0.35, 1e-15);
  EXPECT_NEAR(points[2].phi, 0.525, 1e-15);
  for (const BoxPoint& p : points) {
    EXPECT_NEAR(p.stokes, 20, 1e-12) << "between 10 and 40, in the logarithm";
    EXPECT_EQ(p.regime, "wet");
    EXPECT_EQ(p.restitution, 0.8);
    EXPECT_EQ(p.friction, 0.1);
    EXPECT_EQ(p.share, 0.25);
    EXPECT_TRUE(p.binary);
    EXPECT_FALSE(p.pushed);
    EXPECT_GT(p.seed, 10) << "one that no plan has";
  }
  t.phi = {0.3, 0.5};
  t.stokes = {10};
  const std::vector<BoxPoint> one = points_between(t, plan);
  ASSERT_EQ(one.size(), 1U) << "of one distance, its middle alone";
  EXPECT_NEAR(one[0].phi, 0.4, 1e-15);
  EXPECT_EQ(one[0].stokes, 10);
}

}  // namespace
}  // namespace polybed::multiscale
