// Exchange of two species that drift slowly: against Chapman and Enskog, and what it must not depend on.
#include "closures/species_exchange_kinetic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace polybed::closures {
namespace {

// kT/(n D_12), D_12 = 3/(8 n d_12^2) sqrt(kT/(2 pi mu)), per volume n_1 n_2: (8/3) n_1 n_2 d_12^2 sqrt(2 pi mu kT), of
// spheres of 1 and 2 mm, masses 1 and 8 mg, 1e6 and 2e5 in a cubic metre, kT = 1e-9 J; by hand:
// mu = 8/9 mg, d_12 = 1.5 mm: 8/3 1e6 2e5 2.25e-6 sqrt(2 pi 8/9 1e-6 1e-9) = 1.2e6 sqrt(5.585054e-15) = 0.0896799.
TEST(SpeciesExchangeKinetic, IsChapmanAndEnskogAtRestitutionOne) {
  const double v = std::numbers::pi / 6 * 1e-9, density = 1e-6 / v;
  const DriftingSpecies one{1e-3, density, 1e6 * v, 1e-3}, two{2e-3, density, 2e5 * 8 * v, 1e-3 / 8};
  EXPECT_NEAR(species_exchange_kinetic(one, two, 1, 1), 0.0896799, 1e-7);
  EXPECT_DOUBLE_EQ(species_exchange_kinetic(one, two, 2, 0.6), 2 * 0.8 * species_exchange_kinetic(one, two, 1, 1));
  EXPECT_DOUBLE_EQ(species_exchange_kinetic(two, one, 1, 0.9), species_exchange_kinetic(one, two, 1, 0.9));
}

}  // namespace
}  // namespace polybed::closures
