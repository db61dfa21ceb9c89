// The drag of non-spherical particles, against the formulas worked out by hand.
#include "closures/shape_factor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "closures/drag.hpp"
#include "closures/terminal_velocity.hpp"

namespace polybed::closures {
namespace {

constexpr double digits_of_shapes = 1e-6;  // those of the hand values

/// C_D Re/24 and the factor of a law.
struct ShapeByHand {
  ShapeDrag (*law)(double);
  double psi, re, drag_coefficient, factor;
};

// C_D from the published forms, in Python: with psi = 0.8 Haider and Levenspiel's A = exp(2.3288 - 5.16648 + 1.567104)
// = 0.280670, B = 0.5416, C = exp(4.905 - 11.11552 + 11.790208 - 5.2530688) = 1.386273, D = exp(1.4681 + 9.80672 -
// 13.268608 + 8.133376) = 463.8624, at Re = 100: 0.24 (1 + 0.280670 100^0.5416) + 1.386273/5.638624 = 1.301697.
// Ganser's K1 = 1/(1/3 + (2/3) 0.8^-0.5) = 0.927051, K2 = 10^(1.8148 0.0969100^0.5743) = 2.985433, at Re = 100: X =
// 276.7648, C_D = 2.985433 [24/X (1 + 0.1118 X^0.6567) + 0.4305/(1 + 3305/X)] = 1.520403.
constexpr ShapeByHand shapes_by_hand[] = {{haider_levenspiel, 0.94, 1, 28.95241, 1.016948},
                                          {haider_levenspiel, 0.8, 100, 1.301697, 1.132063},
                                          {haider_levenspiel, 0.5, 300, 3.419318, 4.783540},
                                          {ganser, 0.94, 300, 0.7143821, 1.444678},
                                          {ganser, 0.8, 100, 1.520403, 1.889197},
                                          {ganser, 0.5, 1, 42.19772, 1.581426}};

TEST(ShapeFactor, IsThatOfThePublishedFormulas) {
  for (const ShapeByHand& one : shapes_by_hand) {
    EXPECT_NEAR(one.law(one.psi)(one.re).f * 24 / one.re, one.drag_coefficient,
                digits_of_shapes * one.drag_coefficient);
    const ShapeFactor factor{one.law(one.psi), one.law(1)};
    EXPECT_NEAR(factor(0.5, one.re), one.factor, digits_of_shapes * one.factor);
  }
}

TEST(ShapeFactor, IsExactlyOneOfASphere) {
  for (const ShapeLaw& law : shape_laws)
    for (const double re : {0.0, 1e-3, 1.0, 77.0, 1e4, 1e7}) {
      EXPECT_EQ(shape_factor(law, 1)(0.4, re), 1) << law.name << re;
      const DragValue drag = shape_factor(law, 1)(DragValue{2.3, 0.7}, 0.4, re);
      EXPECT_EQ(drag.f, 2.3);
      EXPECT_EQ(drag.re_dfdre, 0.7);
    }
  EXPECT_EQ(ShapeFactor()(0.4, 5), 1);
}

// Creeping flow: Ganser's 1/K1 = 1/3 + (2/3) psi^-1/2, by hand 1.0786893 at 0.8; Haider and Levenspiel's is 1. Newton:
// the ratio of their last terms, by hand 2.985433 and 1.386273/0.4373157 = 3.169960; what is left at 1e30 is 1e-10.
TEST(ShapeFactor, HasTheLimitsOfCreepingAndFastFlow) {
  EXPECT_NEAR(shape_factor(shape_laws[1], 0.8)(1, 0), 1.0786893, 1e-7);
  EXPECT_EQ(shape_factor(shape_laws[2], 0.8)(1, 0), 1);
  EXPECT_NEAR(shape_factor(shape_laws[1], 0.8)(1, 1e30), 2.985433, 1e-6);
  EXPECT_NEAR(shape_factor(shape_laws[2], 0.8)(1, 1e30), 3.169960, 2e-6);
}

/// A central difference of second order: h^2 of 1e-4 leaves 1e-7.
TEST(ShapeFactor, DerivativeIsThatOfTheFactor) {
  constexpr double h = 1e-4;
  for (const ShapeLaw& law : shape_laws)
    for (const double psi : {0.2, 0.6, 0.94})
      for (const double re : {0.01, 1.0, 100.0, 2e4}) {
        const ShapeFactor factor = shape_factor(law, psi);
        const auto f = [&](double r) { return (1 + 0.15 * std::pow(r, 0.687)) * factor(0.4, r); };
        const double single = 0.15 * std::pow(re, 0.687), slope = (f(re * (1 + h)) - f(re * (1 - h))) / (2 * h);
        EXPECT_NEAR(factor(DragValue{1 + single, 0.687 * single}, 0.4, re).re_dfdre, slope, 1e-6 * f(re)) << law.name;
      }
}

// Solvers need it: u f(u) grows with u even for the drag of Stokes, whose f does not.
TEST(ShapeFactor, DragGrowsWithTheVelocity) {
  for (const ShapeLaw& law : shape_laws)
    for (double psi = 0.2; psi < 1; psi += 0.01)
      for (double re = 1e-4; re < 1e7; re *= 1.3) {
        const DragValue drag = shape_factor(law, psi)(DragValue{1, 0}, 0.4, re);
        EXPECT_GT(drag.f + drag.re_dfdre, 0) << law.name << " " << psi << " " << re;
      }
}

// 1/(0.5/1 + 0.5/2) over 1/(0.5/(0.8 1) + 0.5/(0.5 2)) = 0.75/1.125, by hand; two species of one shape have it.
TEST(ShapeFactor, MeanSphericityHasTheSurfaceOfAll) {
  const double share[] = {0.5, 0.5}, diameter[] = {1, 2}, one[] = {0.8, 0.5}, same[] = {0.7, 0.7};
  EXPECT_NEAR(mean_sphericity(one, share, diameter), 0.75 / 1.125, 1e-15);
  EXPECT_NEAR(mean_sphericity(same, share, diameter), 0.7, 1e-15);
}

// By bisection in Python, 1 mm, 1500 kg/m3 heavier than water: 0.1459455 m/s of a sphere, 0.0970707 of Ganser's 0.8.
TEST(ShapeFactor, LowersTheTerminalVelocity) {
  EXPECT_NEAR(settling_velocity(1e-3, 1500, 1000, 1e-3, 9.81), 0.1459455, 1e-7);
  EXPECT_NEAR(settling_velocity(1e-3, 1500, 1000, 1e-3, 9.81, shape_factor(shape_laws[1], 0.8)), 0.0970707, 1e-7);
}

// At psi 0.939, voidage 0.4 and Re 300, Re/(1-eps) = 500: (1/0.939^2 + 1.75/150 500/0.939)/(1 + 1.75/150 500) =
// (1.1341460 + 6.2122826)/6.8333333 = 1.0750871.
TEST(ShapeFactor, OfAPackedBedIsThatOfErgun) {
  EXPECT_NEAR(shape_factor(shape_laws[0], 0.939)(0.4, 300), 1.0750871, 1e-6);
  // The particle's drag by Ergun's law with psi D: f is over 3 pi mu D u and D^3 a volume, so it is f(psi Re)/psi^2.
  const DragLaw ergun_law = drag_law("ergun", Guard::on);
  for (const double psi : {0.3, 0.8, 0.95})
    for (const double eps : {0.4, 0.7})
      for (const double re : {1e-3, 10.0, 1e3})
        EXPECT_NEAR(shape_factor(shape_laws[0], psi)(eps, re) * pure_drag_at(ergun_law, eps, re),
                    pure_drag_at(ergun_law, eps, psi * re) / (psi * psi),
                    1e-13 * pure_drag_at(ergun_law, eps, re) / psi / psi);
}

// Every way to ask a law has the factor: a mixture, cells and points; and no other part of the law moves.
TEST(ShapeFactor, MultipliesEachSpeciesOfALaw) {
  const double share[] = {0.3, 0.7}, diameter[] = {1e-3, 2e-3}, slip[] = {0.02, 0.05};
  for (const auto& [name, formula] : {std::pair{"wen_yu", 1}, {"brinkman_oseen", 1}, {"cello", 0}, {"gidaspow", 0}}) {
    const DragLaw plain = drag_law(name, Guard::on);
    const ShapeLaw& of = shape_laws[formula];
    DragLaw law = plain;
    law.shape = {{shape_factor(of, 0.8), shape_factor(of, 1)}, shape_factor(of, 0.9)};
    double f[2], slope[2], shaped[2], shaped_slope[2];
    drag_of_mixture(plain, 0.6, share, diameter, slip, 1000, 1e-3, f, slope);
    drag_of_mixture(law, 0.6, share, diameter, slip, 1000, 1e-3, shaped, shaped_slope);
    const double factor = law.shape->species[0](0.6, 20);  // 1000 0.02 1e-3/1e-3
    EXPECT_NEAR(shaped[0], factor * f[0], 1e-14 * f[0]) << name;
    EXPECT_EQ(shaped[1], f[1]);
    EXPECT_EQ(shaped_slope[1], slope[1]);

    const double eps = 0.6, *shares[] = {&share[0], &share[1]}, *slips[] = {&slip[0], &slip[1]};
    double cell[2], *cells[] = {&cell[0], &cell[1]};
    GuardCount count;
    drag_of_cells(law, {&eps, 1}, shares, slips, diameter, 1000, 1e-3, cells, count);
    for (int j = 0; j < 2; ++j) EXPECT_NEAR(cell[j], shaped[j], 1e-12 * f[j]) << name;

    const double mean = pure_drag_at(law, 0.6, 50) / pure_drag_at(plain, 0.6, 50);
    EXPECT_NEAR(mean, law.shape->mean(0.6, 50), 1e-14);
    EXPECT_NEAR(pure_drag_at(law.alone(0), 0.6, 20) / pure_drag_at(plain, 0.6, 20), factor, 1e-14);
  }
}

}  // namespace
}  // namespace polybed::closures
