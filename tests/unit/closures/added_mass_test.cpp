// Added mass of one sphere and of a swarm.
#include <gtest/gtest.h>

#include "closures/added_mass.hpp"

namespace polybed::closures {
namespace {

TEST(AddedMass, ByHand) {
  EXPECT_EQ(added_mass_zuber(0), added_mass_of_one);
  EXPECT_DOUBLE_EQ(added_mass_zuber(0.25), 1);      // 1.5/1.5
  EXPECT_DOUBLE_EQ(added_mass_zuber(0.3), 8. / 7);  // 1.6/1.4
  EXPECT_DOUBLE_EQ(added_mass_zuber(0.5), 2);       // 2/1
  // C_m rho_f V of 2 mm in water: 0.5 1000 (pi/6) 8e-9.
  EXPECT_NEAR(added_mass_inertia(added_mass_of_one, 1000, 2e-3), 2.0943951023931954e-6, 1e-20);
}

TEST(AddedMass, GrowsAndStaysFinite) {
  for (double phi = 0; phi < added_mass_largest_fraction; phi += 0.01)
    EXPECT_GT(added_mass_zuber(phi + 0.005), added_mass_zuber(phi));
  EXPECT_NEAR(added_mass_zuber(added_mass_largest_fraction), 4.769230769230769, 1e-14);  // 2.48/0.52
  for (const double phi : {0.8, 1.0, 1.5}) EXPECT_EQ(added_mass_zuber(phi), added_mass_zuber(0.74));
  EXPECT_EQ(added_mass_zuber(-0.1), 0.5);
}

TEST(AddedMass, LightSphereStartsWithTheBuoyancyOfItsDisplacedFluid) {
  // (m + C_m rho_f V) a = (rho_f - rho_p) g V: a = 2 g for a bubble without mass.
  const double volume = added_mass_inertia(1, 1, 1e-3);
  EXPECT_NEAR(1000 * 9.81 * volume / added_mass_inertia(added_mass_of_one, 1000, 1e-3), 19.62, 1e-13);
}

}  // namespace
}  // namespace polybed::closures
