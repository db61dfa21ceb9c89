// Neighbours of a hard sphere, against the closed form of one species and Baxter's factorisation of a mixture.
#include "closures/sphere_neighbours.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace polybed::closures {
namespace {

constexpr double of_a_system = 1e-11;  // of a system of four, whose entries reach 1e4 at phi = 0.7

// (1 - phi)^4/(1 + 2 phi)^2.
TEST(SphereNeighbours, OfOneSpeciesAreThoseOfPercusAndYevick) {
  for (const double phi : {0.0, 1e-8, 0.1, 0.2, 0.5, 0.7}) {
    const double d = 2e-3, expected = std::pow(1 - phi, 4) / std::pow(1 + 2 * phi, 2);
    EXPECT_NEAR(SphereNeighbours({&phi, 1}, {&d, 1}).excess(d, d, phi, true), expected, of_a_system) << phi;
  }
}

// phi 0.1 and 0.08, D 1 and 2.5: (Q^T Q)^-1 of Baxter's Q_ij(0), integrated elsewhere by Gauss's rule.
TEST(SphereNeighbours, OfAMixtureAreThoseOfBaxter) {
  const std::array<double, 2> phi{0.1, 0.08}, d{1e-3, 2.5e-3};
  const SphereNeighbours around(phi, d);
  const double expected[2][2] = {{0.88299957, -0.12130502}, {-2.36923875, 0.60231463}};
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      EXPECT_NEAR(around.excess(d[i], d[j], phi[j], i == j), expected[i][j], 5e-9) << i << j;  // as printed
}

// A species cut in two has the neighbours of the whole.
TEST(SphereNeighbours, ASpeciesMayBeCutInTwo) {
  const std::array<double, 2> phi{0.1, 0.2}, d{1e-3, 1e-3};
  const double whole = 0.3;
  const SphereNeighbours cut(phi, d), one({&whole, 1}, {&d[0], 1});
  EXPECT_NEAR(cut.excess(d[0], d[0], phi[0], true) + cut.excess(d[0], d[1], phi[1], false),
              one.excess(d[0], d[0], whole, true), of_a_system);
}

TEST(SphereNeighbours, AbsentSpeciesAreAlone) {
  const std::array<double, 2> phi{0.3, 0}, d{1e-3, 3e-3};
  const SphereNeighbours around(phi, d);
  EXPECT_EQ(around.excess(d[0], d[1], phi[1], false), 0);
  EXPECT_EQ(around.excess(d[1], d[1], phi[1], true), 1);
}

TEST(SphereNeighbours, BeyondTheDensestPackingTheyAreThoseOfIt) {
  const double d = 1e-3, phi = 0.9, most = SphereNeighbours::most_fraction;
  EXPECT_NEAR(SphereNeighbours({&phi, 1}, {&d, 1}).excess(d, d, most, true),
              SphereNeighbours({&most, 1}, {&d, 1}).excess(d, d, most, true), of_a_system);
}

}  // namespace
}  // namespace polybed::closures
