// The drag law brinkman_oseen: reference points, limits, guard, derivative, and what must hold for every mixture.
#include "closures/drag_brinkman_oseen.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "closures/drag.hpp"

namespace polybed::closures {
namespace {

/// Net force over Stokes of species j: n_j = f_j + (1-eps) y_j^2 f_mean/eps, T(3.13)-(3.17).
double net_over_stokes(double voidage, double f_pure, double poly_index, double f_mean) {
  return f_pure + (1 - voidage) * poly_index * poly_index * f_mean / voidage;
}

struct OneSlip {
  double eps, re;  ///< Re of the Sauter diameter, one slip for all
  std::vector<double> share, diameter;
};

struct Pure {
  std::vector<double> f, slope;
  double mean;
};

Pure pure_of(const OneSlip& m, Guard guard = Guard::off) {
  const DragLaw law = drag_law("brinkman_oseen", guard);
  const std::size_t species = m.share.size();
  const double mean = sauter_diameter(m.share, m.diameter);
  Pure a{std::vector<double>(species), std::vector<double>(species), 0};
  const std::vector<double> slip(species, m.re / mean);  // density and viscosity 1
  drag_of_mixture(law, m.eps, m.share, m.diameter, slip, 1, 1, a.f, a.slope);
  a.mean = drag_of_mean(law, m.eps, m.re, m.share, m.diameter, a.f);
  return a;
}

TEST(BrinkmanOseen, ReferencePoints) {
  // Twelve digits, computed apart from this code; 1e-10 leaves two for their rounding and ours.
  struct Point {
    OneSlip mixture;
    std::vector<double> f, n;
  };
  const Point points[] = {
      {{1, 0, {1}, {1}}, {1}, {1}},
      {{1, 10, {1}, {1}}, {1.80209460646}, {1.80209460646}},
      {{0.9, 0, {1}, {1}}, {2.55178507509}, {2.83531675010}},
      {{0.5, 100, {1}, {1}}, {51.3819969639}, {102.763993928}},
      {{0.4, 1000, {1}, {1}}, {443.725012364}, {1109.31253091}},
      {{0.6, 0, {0.5, 0.5}, {1, 2}}, {8.61319416993, 19.3548704438}, {13.0971647636, 37.2907528183}},
      {{0.5, 100, {0.25, 0.75}, {1, 4}}, {20.1596526968, 112.250942927}, {30.4613288206, 277.077760909}},
      {{0.75, 10, {0.25, 0.25, 0.25, 0.25}, {1, 2, 3, 4}},
       {4.06309119347, 7.12761512448, 10.6844750580, 14.7521725484},
       {4.72593866465, 9.77900500921, 16.6501022987, 25.3577320873}}};
  for (const Point& p : points) {
    const Pure a = pure_of(p.mixture);
    const double mean = sauter_diameter(p.mixture.share, p.mixture.diameter);
    for (std::size_t j = 0; j < p.f.size(); ++j) {
      EXPECT_NEAR(a.f[j], p.f[j], 1e-10 * p.f[j]);
      EXPECT_NEAR(net_over_stokes(p.mixture.eps, a.f[j], p.mixture.diameter[j] / mean, a.mean), p.n[j], 1e-10 * p.n[j]);
    }
  }
  EXPECT_NEAR(pure_of(points[5].mixture).mean, 11.9572549163, 1e-10 * 11.96);
  EXPECT_NEAR(pure_of(points[6].mixture).mean, 53.8210017900, 1e-10 * 53.82);
  EXPECT_NEAR(pure_of(points[7].mixture).mean, 7.33056275331, 1e-10 * 7.331);
  EXPECT_NEAR(pure_of(points[6].mixture).slope[1], 62.7618323, 5e-8);  // the digits given
}

TEST(BrinkmanOseen, GuardBeyondTheData) {
  const DragBrinkmanOseen law;
  EXPECT_NEAR(law(0.5, 2000).f, 450.98588, 5e-6);  // the digits given
  EXPECT_NEAR(law(1, 1e4).f, 175.02162, 5e-6);
  for (const double eps : {0.4, 0.7, 1.0}) {  // C1 at Re 1050: by 1e-6 of Re, of a second derivative of order f/Re^2
    const DragValue below = law(eps, 1050), above = law(eps, 1050 * (1 + 1e-6));
    EXPECT_NEAR(above.f, below.f + 1e-6 * below.re_dfdre, 1e-11 * below.f);
    EXPECT_NEAR(above.re_dfdre, below.re_dfdre, 1e-5 * below.re_dfdre);
  }
  EXPECT_EQ(law(0.5, 1000).f, (DragBrinkmanOseen{{}, Guard::off}(0.5, 1000).f));
}

TEST(BrinkmanOseen, LimitsOfOneSize) {
  const DragBrinkmanOseen law;
  EXPECT_EQ(law(1, 0).f, 1);
  EXPECT_EQ(law(1, 0).re_dfdre, 0);
  EXPECT_EQ(law(1 + 1e-9, 0).f, 1);  // round-off of a voidage
  // Oseen's slope 3/16, 4.3 % high.
  EXPECT_NEAR((law(1, 1e-5).f - 1) / 1e-5, 1.04289 * 3 / 16, 1e-5);
  for (const double phi : {1e-3, 1e-4, 1e-5}) {  // a dilute fixed random bed; the next term is of order phi^1.5
    const double theory =
        1 + 3 / std::numbers::sqrt2 * std::sqrt(phi) + 135.0 / 64 * phi * std::log(phi) + 16.456 * phi;
    EXPECT_NEAR(law(1 - phi, 0).f / (1 - phi), theory, 20 * std::pow(phi, 1.5));
  }
  EXPECT_NEAR(law(0.01, 0).f / (10 * 0.99 / 1e-4), 1, 1e-12);  // Kozeny-Carman; the rest is of order eps^7
}

TEST(BrinkmanOseen, LimitsOfMixtures) {
  for (const double phi : {1e-4, 1e-6}) {  // dilute: 1 + (3/sqrt 2) sqrt(phi m2) y_j, to order phi ln phi
    const OneSlip m{1 - phi, 0, {0.3, 0.7}, {1, 3}};
    const double mean = sauter_diameter(m.share, m.diameter), m2 = mean * mean * (0.3 / 1 + 0.7 / 9);
    const Pure a = pure_of(m);
    for (std::size_t j = 0; j < 2; ++j)
      EXPECT_NEAR(a.f[j], 1 + 3 / std::numbers::sqrt2 * std::sqrt(phi * m2) * m.diameter[j] / mean,
                  -20 * phi * std::log(phi));
  }
  const double giant[] = {0.999, 0.987, 0.951, 0.876, 0.75, 0.58};
  for (int n = 1; n <= 6; ++n) {
    const double phi = 0.1 * n;
    // A trace of another size, 1e-6 and 1e6 of the bed's: what is left is of the order of that ratio times f.
    const Pure tiny = pure_of({1 - phi, 0, {0, 1}, {1e-6, 1}}), large = pure_of({1 - phi, 0, {0, 1}, {1e6, 1}});
    EXPECT_NEAR(tiny.f[0], 1 / (1 - phi), 1e-3);
    const double porous_sphere = phi / (2 * (1 - phi)) * large.mean * 1e12;
    EXPECT_NEAR(large.f[0] / porous_sphere, giant[n - 1], n < 5 ? 5.1e-4 : 5e-3);  // the digits given
  }
}

OneSlip random_one_slip(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const std::size_t species = 2 + std::size_t(3 * uniform(random));
  OneSlip m{0.3 + 0.7 * uniform(random), std::pow(10.0, 8 * uniform(random) - 3), {}, {}};
  double sum = 0;
  for (std::size_t j = 0; j < species; ++j) {
    m.share.push_back(std::pow(uniform(random), 3) + 1e-9);
    m.diameter.push_back(std::pow(300.0, uniform(random)));
    sum += m.share.back();
  }
  for (double& x : m.share) x /= sum;
  return m;
}

TEST(BrinkmanOseen, EveryMixtureIsDraggedMoreThanByThePressure) {
  std::mt19937_64 random(5);
  int below = 0, falls_with_re = 0, falls_with_phi = 0;
  for (int n = 0; n < 200'000; ++n) {
    const OneSlip m = random_one_slip(random);
    const Pure here = pure_of(m, Guard::on), faster = pure_of({m.eps, 1.01 * m.re, m.share, m.diameter}, Guard::on),
               denser = pure_of({m.eps - 1e-3, m.re, m.share, m.diameter}, Guard::on);
    for (std::size_t j = 0; j < m.share.size(); ++j) {
      below += here.f[j] * m.eps < 1 - 1e-15;
      falls_with_re += faster.f[j] < here.f[j] * (1 - 1e-13);
      falls_with_phi += denser.f[j] < here.f[j] * (1 - 1e-13);
    }
  }
  EXPECT_EQ(below, 0);
  EXPECT_EQ(falls_with_re, 0);
  EXPECT_EQ(falls_with_phi, 0);
}

TEST(BrinkmanOseen, SplittingOrPermutingSpeciesChangesNothing) {
  std::mt19937_64 random(6);
  for (int n = 0; n < 1000; ++n) {
    const OneSlip m = random_one_slip(random);
    OneSlip split = m;
    split.share.push_back(0.3 * m.share[0]);
    split.diameter.push_back(m.diameter[0]);
    split.share[0] *= 0.7;
    std::swap(split.share[0], split.share[1]);
    std::swap(split.diameter[0], split.diameter[1]);
    const Pure whole = pure_of(m, Guard::on), parts = pure_of(split, Guard::on);
    EXPECT_NEAR(parts.f[1], whole.f[0], 1e-12 * whole.f[0]);
    EXPECT_NEAR(parts.f.back(), whole.f[0], 1e-12 * whole.f[0]);
    EXPECT_NEAR(parts.mean, whole.mean, 1e-12 * whole.mean);
  }
}

TEST(BrinkmanOseen, DerivativeOfASpeciesIsThatOfTheLaw) {
  std::mt19937_64 random(7);
  for (int n = 0; n < 1000; ++n) {
    const OneSlip m = random_one_slip(random);
    const double step = 1e-5;
    const Pure here = pure_of(m, Guard::on), up = pure_of({m.eps, m.re * (1 + step), m.share, m.diameter}, Guard::on),
               down = pure_of({m.eps, m.re * (1 - step), m.share, m.diameter}, Guard::on);
    for (std::size_t j = 0; j < m.share.size(); ++j)  // central differences: truncation 1e-10, round-off 1e-11 of f
      EXPECT_NEAR((up.f[j] - down.f[j]) / (2 * step), here.slope[j], 1e-6 * (here.f[j] + here.slope[j]));
  }
}

}  // namespace
}  // namespace polybed::closures
