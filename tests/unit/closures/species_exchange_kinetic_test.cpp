// Exchange of two species that drift: against Chapman and Enskog, against two streams, and what it must not depend on.
#include "closures/species_exchange_kinetic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "closures/species_exchange_syamlal.hpp"

namespace polybed::closures {
namespace {

// kT/(n D_12), D_12 = 3/(8 n d_12^2) sqrt(kT/(2 pi mu)), per volume n_1 n_2: (8/3) n_1 n_2 d_12^2 sqrt(2 pi mu kT), of
// spheres of 1 and 2 mm, masses 1 and 8 mg, 1e6 and 2e5 in a cubic metre, kT = 1e-9 J; by hand:
// mu = 8/9 mg, d_12 = 1.5 mm: 8/3 1e6 2e5 2.25e-6 sqrt(2 pi 8/9 1e-6 1e-9) = 1.2e6 sqrt(5.585054e-15) = 0.0896799.
TEST(SpeciesExchangeKinetic, IsChapmanAndEnskogAtRestitutionOne) {
  const double v = std::numbers::pi / 6 * 1e-9, density = 1e-6 / v;
  const DriftingSpecies one{1e-3, density, 1e6 * v, 1e-3}, two{2e-3, density, 2e5 * 8 * v, 1e-3 / 8};
  EXPECT_NEAR(species_exchange_kinetic(one, two, 1, 1, 0), 0.0896799, 1e-7);
  EXPECT_DOUBLE_EQ(species_exchange_kinetic(one, two, 2, 0.6, 0),
                   2 * 0.8 * species_exchange_kinetic(one, two, 1, 1, 0));
  EXPECT_DOUBLE_EQ(species_exchange_kinetic(two, one, 1, 0.9, 0.1), species_exchange_kinetic(one, two, 1, 0.9, 0.1));
}

// By hand at s = 1: (3 sqrt(pi)/8) [1.5 x 0.36787944/1.77245385 + 1.75 x 0.84270079] = 0.66467019 x 1.78605682.
TEST(SpeciesExchangeKinetic, DriftAddsToTheThermalSpeed) {
  EXPECT_NEAR(drift_factor(1), 1.187139, 1e-6);
  EXPECT_EQ(drift_factor(0), 1);
  // Where the forms meet: their own derivatives are 0.008 and 0.66 at 0.02 and 6, times the step of 2e-9.
  EXPECT_NEAR(drift_factor(0.02 - 1e-9), drift_factor(0.02 + 1e-9), 1e-10);
  EXPECT_NEAR(drift_factor(6 - 1e-9), drift_factor(6 + 1e-9), 2e-9);
}

// Two streams without agitation meet as Syamlal's smooth spheres do, and agitation of a millionth of their drift
// changes nothing that could be told.
TEST(SpeciesExchangeKinetic, FastDriftIsSyamlals) {
  DriftingSpecies one{1e-3, 2500, 0.1, 0}, two{2e-3, 1500, 0.2, 0};
  const SpeciesPair pair{1e-3, 2e-3, 2500, 1500, 0.8, 0};
  const double syamlal = 0.1 * 0.2 * species_exchange(pair, 1.7, 0.3, 0);
  EXPECT_NEAR(species_exchange_kinetic(one, two, 1.7, 0.8, 0.3), syamlal, 1e-12 * syamlal);
  one.theta = two.theta = 1e-14;
  EXPECT_NEAR(species_exchange_kinetic(one, two, 1.7, 0.8, 0.3), syamlal, 1e-11 * syamlal);
  EXPECT_EQ(species_exchange_kinetic(one, two, 1.7, 0.8, 0), species_exchange_kinetic(two, one, 1.7, 0.8, 0));
  one.theta = two.theta = 0;
  EXPECT_EQ(species_exchange_kinetic(one, two, 1.7, 0.8, 0), 0) << "at rest";
}

}  // namespace
}  // namespace polybed::closures
