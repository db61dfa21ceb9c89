// The guard of the drag laws: hand values, positive, monotone, smooth; and that the bare law of the thesis is not.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "closures/drag.hpp"

namespace polybed::closures {
namespace {

DragValue at(const DragLaw& law, double eps, double re) {
  DragValue value{};
  GuardCount count;
  drag_of_points(law, {&eps, 1}, {&re, 1}, {&value.f, 1}, {&value.re_dfdre, 1}, count);
  return value;
}

/// Omega_j of every species.
std::vector<double> omegas(const MixtureCello& law, double eps, const std::vector<double>& share,
                           const std::vector<double>& diameter) {
  const MixtureCell cell = mixture_cell(law, eps, composition_of(share, diameter));
  std::vector<double> result;
  for (std::size_t j = 0; j < share.size(); ++j) result.push_back(law.term(cell, diameter[j], share[j]).factor);
  return result;
}

TEST(DragGuard, HandValues) {
  // Computed apart from this code with the guard's formulas, nine and more digits.
  const DragCello law;
  const double expected[][4] = {{0.30, 100, 192.018043, 103.265214},
                                {0.30, 1000, 975.971626, 704.841302},
                                {0.36, 1000, 633.727388, 475.864700},
                                {0.40, 2000, 795.135010, 696.746903},
                                {1, 1e4, 174.283152, 193.602949}};
  for (const auto& row : expected) {
    const DragValue value = law(row[0], row[1]);
    EXPECT_NEAR(value.f, row[2], 1e-8 * row[2]);
    EXPECT_NEAR(value.re_dfdre, row[3], 1e-8 * row[3]);
  }
  const std::vector<double> omega = omegas(MixtureCello{}, 0.28, {0.003, 0.997}, {1, 20});
  EXPECT_NEAR(omega[0], 0.00693714, 1e-8);
  EXPECT_NEAR(omega[1], 1.11226121, 1e-8);
}

/// Least f, falling f in Re, and rising f in eps over random points; the counts of what a law must not do.
struct Misbehaviour {
  int not_positive = 0, falls_with_re = 0, rises_with_voidage = 0;
};

Misbehaviour search(Guard guard, int points) {
  const DragCello law{{}, guard};
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> voidage(0.02, 0.999), exponent(-3, 6);
  Misbehaviour found;
  for (int n = 0; n < points; ++n) {
    const double eps = voidage(random), re = std::pow(10.0, exponent(random));
    const double f = law(eps, re).f;
    found.not_positive += f >= 1 ? 0 : 1;
    found.falls_with_re += law(eps, re * 1.01).f >= f * (1 - 1e-13) ? 0 : 1;
    found.rises_with_voidage += law(eps + 1e-3, re).f <= f * (1 + 1e-13) ? 0 : 1;
  }
  return found;
}

TEST(DragGuard, CelloIsAtLeastOneAndMonotone) {
  const Misbehaviour guarded = search(Guard::on, 1'000'000);
  EXPECT_EQ(guarded.not_positive, 0);
  EXPECT_EQ(guarded.falls_with_re, 0);
  EXPECT_EQ(guarded.rises_with_voidage, 0);
  const Misbehaviour bare = search(Guard::off, 10'000);
  EXPECT_GT(bare.not_positive, 0) << "the bare law would need no guard";
  EXPECT_GT(bare.falls_with_re, 0);
}

class EveryLaw : public testing::TestWithParam<std::string> {};

TEST_P(EveryLaw, DerivativeIsThatOfTheLaw) {
  const DragLaw law = drag_law(GetParam(), Guard::on);
  for (double eps : {0.25, 0.36, 0.45, 0.6, 0.79, 0.85, 0.95, 1.0})
    for (double re : {1e-3, 0.3, 1.7, 3.5, 10.0, 40.0, 95.0, 300.0, 700.0, 2000.0}) {
      const double step = 1e-5, up = at(law, eps, re * (1 + step)).f, down = at(law, eps, re * (1 - step)).f;
      const DragValue here = at(law, eps, re);
      // Central differences: truncation 1e-10, round-off 1e-11 of f; 1e-6 of the larger of f and the slope.
      EXPECT_NEAR((up - down) / (2 * step), here.re_dfdre, 1e-6 * (here.f + std::abs(here.re_dfdre)))
          << GetParam() << " " << eps << " " << re;
    }
}

TEST_P(EveryLaw, IsFiniteAtTheEdges) {
  const DragLaw law = drag_law(GetParam(), Guard::on);
  for (double eps : {0.30, 0.5, 1.0, 1.0 + 1e-9})
    for (double re : {0.0, 5e-324, 1e-300, 1e-8, 1e6}) {
      const DragValue value = at(law, eps, re);
      EXPECT_TRUE(std::isfinite(value.f) && std::isfinite(value.re_dfdre)) << GetParam() << " " << eps << " " << re;
      EXPECT_GE(value.f, 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Drag, EveryLaw, testing::ValuesIn(drag_law_names()));

TEST(DragGuard, SumRuleHoldsForEveryMixture) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int n = 0; n < 20000; ++n) {
    const std::size_t species = 2 + n % 5;
    std::vector<double> share(species), diameter(species);
    double sum = 0;
    for (std::size_t j = 0; j < species; ++j) {
      share[j] = std::pow(uniform(random), 3);
      diameter[j] = std::pow(300.0, uniform(random));
      sum += share[j];
    }
    for (double& x : share) x /= sum;
    const double eps = 0.1 + 0.9 * uniform(random), mean = sauter_diameter(share, diameter);
    for (const Guard guard : {Guard::on, Guard::off}) {
      const std::vector<double> omega = omegas({{{}, guard}}, eps, share, diameter);
      double rule = 0, size = 0;
      for (std::size_t j = 0; j < species; ++j) {
        const double y = diameter[j] / mean;
        rule += share[j] * omega[j] / (y * y);
        size += share[j] * std::abs(omega[j]) / (y * y);
        if (guard == Guard::on) {
          EXPECT_GT(omega[j], 0.033 * y);
        }
      }
      EXPECT_NEAR(rule, 1, 1e-12 * std::max(size, 1.0));
    }
  }
}

TEST(DragGuard, UsesAreCounted) {
  const std::vector<double> eps{0.5, 0.2, 0.5}, re{10, 10, 2000};
  std::vector<double> f(3), slope(3);
  GuardCount count;
  drag_of_points(drag_law("cello", Guard::on), eps, re, f, slope, count);
  EXPECT_EQ(count.evaluations, 3u);
  EXPECT_EQ(count.guarded, 2u);
}

TEST(DragGuard, BatchEqualsSingleCells) {
  constexpr std::size_t cells = 300;  // more than are worked on together, and not a multiple of that
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> voidage(cells), x1(cells), x2(cells), u1(cells), u2(cells), f1(cells), f2(cells);
  for (std::size_t c = 0; c < cells; ++c) {
    voidage[c] = c == 0 ? 1 + 1e-9 : 0.25 + 0.75 * uniform(random);
    x1[c] = c == 1 ? 0 : uniform(random);
    x2[c] = 1 - x1[c];
    u1[c] = c == 2 ? 0 : std::pow(10.0, 4 * uniform(random) - 4);
    u2[c] = std::pow(10.0, 4 * uniform(random) - 4);
  }
  const std::vector<double> diameter{1e-3, 3e-3};
  for (const std::string& name : drag_law_names()) {
    const DragLaw law = drag_law(name, Guard::on);
    const std::vector<const double*> share{x1.data(), x2.data()}, slip{u1.data(), u2.data()};
    const std::vector<double*> f{f1.data(), f2.data()};
    GuardCount count;
    drag_of_cells(law, voidage, share, slip, diameter, 1000, 1e-3, f, count);
    EXPECT_EQ(count.evaluations, 2 * cells);
    for (std::size_t c = 0; c < cells; ++c) {
      std::vector<double> single(2), slope(2);
      const std::vector<double> x{x1[c], x2[c]}, u{u1[c], u2[c]};
      drag_of_mixture(law, voidage[c], x, diameter, u, 1000, 1e-3, single, slope);
      // Round-off: the batch multiplies by 1/D_j; Richardson and Zaki's q bends, which the bisection may feel.
      EXPECT_NEAR(f1[c], single[0], 1e-12 * single[0]) << name << " " << c;
      EXPECT_NEAR(f2[c], single[1], 1e-12 * single[1]) << name << " " << c;
    }
  }
}

}  // namespace
}  // namespace polybed::closures
