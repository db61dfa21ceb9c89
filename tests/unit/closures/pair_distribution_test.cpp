// Correlations of hard spheres: closed forms of one species, and that spheres of a mixture keep each other out.
#include "closures/pair_distribution.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "closures/sphere_neighbours.hpp"

namespace polybed::closures {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double round_off = 1e-12;

// At x = pi: sin = 0, cos = -1, -4 pi s^3 pi/pi^3 = -4 s^3/pi; at k = 0 less the volume of the excluded sphere.
TEST(ExclusionSpectrum, HasTheValuesByHand) {
  const double s = 2e-3;
  EXPECT_NEAR(exclusion_spectrum(pi / s, s) / (s * s * s), -4 / pi, round_off);
  EXPECT_NEAR(exclusion_spectrum(0, s) / (s * s * s), -4 * pi / 3, round_off);
  // Both sides of where the series ends: it leaves out x^4/280, 4e-11, and the closed form's differences 1e-16/x^3.
  EXPECT_NEAR(exclusion_spectrum(0.00999999 / s, s), exclusion_spectrum(0.01000001 / s, s), 1e-8 * s * s * s);
}

// Dilute spheres only keep each other out: what comes beyond is of the order of phi.
TEST(PercusYevick, DiluteSpheresAreExcludedAlone) {
  const std::array<double, 2> phi{1e-7, 1e-7}, d{1e-3, 2.5e-3};
  const PercusYevick pairs(phi, d);
  for (const double k : {0.0, 300.0, 2000.0, 9000.0}) {
    const Eigen::MatrixXd h = pairs.spectrum(k);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const double contact = 0.5 * (d[std::size_t(i)] + d[std::size_t(j)]);
        EXPECT_NEAR(h(i, j) / std::pow(contact, 3), exclusion_spectrum(k, contact) / std::pow(contact, 3), 1e-5);
      }
  }
}

// At k = 0 what SphereNeighbours has by Lebowitz's direct correlations: rho_j h_ij = T_ij - delta_ij.
TEST(PercusYevick, WideAveragesAreThoseOfLebowitz) {
  const std::array<double, 2> phi{0.1, 0.08}, d{1e-3, 2.5e-3};
  const Eigen::MatrixXd h = PercusYevick(phi, d).spectrum(0);
  const SphereNeighbours around(phi, d);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const double number = phi[j] / (pi / 6 * d[j] * d[j] * d[j]);
      EXPECT_NEAR(number * h(Eigen::Index(i), Eigen::Index(j)),
                  around.excess(d[i], d[j], phi[j], i == j) - (i == j ? 1 : 0), 1e-11);
    }
}

// h(r) = int h(k) k sin(k r) dk/(2 pi^2 r), damped against the wave numbers that are cut off, which blurs h by 1 % of
// a small diameter: -1 within contact, whatever the pair. Beyond it spheres crowd.
TEST(PercusYevick, SpheresKeepEachOtherOut) {
  const std::array<double, 2> phi{0.15, 0.1}, d{1e-3, 2.5e-3};
  const PercusYevick pairs(phi, d);
  constexpr int count = 3000;
  const double most = 300 / d[0], step = most / count;
  const auto at = [&](Eigen::Index i, Eigen::Index j, double r) {
    double sum = 0;
    for (int n = 1; n <= count; ++n) {
      const double k = n * step;
      sum += k * std::sin(k * r) * pairs.spectrum(k)(i, j) * std::exp(-9 * k * k / (most * most));
    }
    return sum * step / (2 * pi * pi * r);
  };
  for (Eigen::Index i = 0; i < 2; ++i)
    for (Eigen::Index j = i; j < 2; ++j) {
      const double contact = 0.5 * (d[std::size_t(i)] + d[std::size_t(j)]);
      for (const double inside : {0.4, 0.9}) EXPECT_NEAR(at(i, j, inside * contact), -1, 3e-3) << i << j << inside;
      EXPECT_GT(at(i, j, 1.06 * contact), 0.3) << i << j;
    }
}

}  // namespace
}  // namespace polybed::closures
