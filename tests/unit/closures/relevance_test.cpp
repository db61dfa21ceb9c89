// Values by hand, with the numbers beside them; 1e-4 where a value was written down with five digits.
#include "closures/relevance.hpp"

#include <gtest/gtest.h>

#include "closures/bed_expansion.hpp"

namespace polybed::closures {
namespace {

constexpr double digits = 1e-4;

// A sphere of 1 mm and 2500 kg/m3 in 1000 kg/m3: pi/6 1e-9 m3 x 1500 kg/m3 x 9.81 m/s2.
TEST(Relevance, HasTheWeightOfASphere) {
  EXPECT_NEAR(buoyant_weight(1e-3, 2500, 1000, 9.81), 7.7048e-6, 7.7048e-6 * digits);
  EXPECT_EQ(buoyant_weight(1e-3, 500, 1000, 9.81), buoyant_weight(1e-3, 1500, 1000, 9.81));
}

TEST(Relevance, RelaxesWithTheDragPerSlip) {
  EXPECT_NEAR(drag_per_slip(1e-3, 1e-3, 0.5, 20), 9.4248e-5, 9.4248e-5 * digits);
  EXPECT_NEAR(slip_relaxation_time(1e-3, 2500, 1e-3, 0.5, 20), 0.013889, 0.013889 * digits);
  const double mass = 2500 * sphere_volume(0.5e-3);
  EXPECT_NEAR(mass / drag_per_slip(1e-3, 1e-3, 0.5, 20), slip_relaxation_time(1e-3, 2500, 1e-3, 0.5, 20), 1e-15);
}

TEST(Relevance, ShearsOverATenthOfTheWidthOrTenDiameters) {
  EXPECT_DOUBLE_EQ(shear_rate_inside(0.1, 1e-3), 10);
  EXPECT_DOUBLE_EQ(shear_rate_at_wall(0.1, 0.05, 1e-3), 20);
  EXPECT_DOUBLE_EQ(shear_rate_at_wall(0.1, 0.2, 1e-3), 10);
  // By hand: 0.1/0.004 + sqrt(2 x 2/0.004) = 25 + 31.6228; half solids of twice the fluid's density fall at g/3.
  EXPECT_NEAR(shear_rate_of_cell(0.1, 2, 4e-3), 56.622777, 1e-6);  // digits
  EXPECT_DOUBLE_EQ(clump_acceleration(0.5, 2000, 1000, 9.81), 9.81 / 3);
  EXPECT_DOUBLE_EQ(clump_acceleration(0.5, 500, 1000, 9), 3);
  EXPECT_DOUBLE_EQ(spin_of_impact(0.07, 1e-3), 100);  // 5/7 of 0.07 m/s over half a millimetre
  EXPECT_DOUBLE_EQ(time_of_scene(0.05, 0.1, 0.01), 0.5);
  EXPECT_DOUBLE_EQ(time_of_scene(0.05, 0.1, 2), 2);
}

TEST(Relevance, OfAddedMassIsAtMostOne) {
  EXPECT_DOUBLE_EQ(added_mass_relevance(0.5, 0.4), 0.2 / 1.2);
  EXPECT_EQ(added_mass_relevance(0.5, 0), 0);
  EXPECT_LT(added_mass_relevance(4, 1e6), 1);
}

// 1.5e-6 sqrt(pi) 0.2/2/7.7048e-6; the kernel of Mei and Adrian at t = 4 s is 1.95e-4 of Basset's.
TEST(Relevance, OfHistoryIsABandAtFiniteReynoldsNumber) {
  const double weight = buoyant_weight(1e-3, 2500, 1000, 9.81);
  const double most = history_relevance(1e-3, 1000, 1e-3, 0.1, 4, weight);
  EXPECT_NEAR(most, 0.034507, 0.034507 * digits);
  EXPECT_NEAR(history_relevance_least(1e-3, 1000, 1e-3, 0.1, 4, weight) / most, 1.95254e-4, 1.95254e-4 * digits);
}

// Their forces have tests of their own: here the direction that makes them greatest.
TEST(Relevance, OfLiftAndSpinIsTheForceOfTheirClosures) {
  const Vec3 lift = lift_saffman_mei({0, 0.02, 0}, {0, 0, 5}, 1e-3, 1000, 1e-3);
  EXPECT_DOUBLE_EQ(lift_relevance(1e-3, 1000, 1e-3, 0.02, 5, 1e-6), std::abs(lift.x) / 1e-6);
  // 0.45 pi/8 x 1000 x 1e-9 x 0.02 x 5/1e-6, Re_p = 20.
  EXPECT_NEAR(magnus_relevance(1e-3, 1000, 1e-3, 0.02, 5, 1e-6), 0.017671, 0.017671 * digits);
}

TEST(Relevance, OfMoleculesFollowsFromTheirHeat) {
  EXPECT_NEAR(mean_free_path(1.204, 1.81e-5, 293.15, 287.05), 6.49514e-8,
              6.49514e-8 * digits);  // handbooks: 65 to 67 nm
  EXPECT_NEAR(gas_slip_relevance(6.5e-8, 10e-6), 0.016341, 0.016341 * digits);
  EXPECT_NEAR(cunningham_divisor(0.1), 1.125701, 1e-6);
  EXPECT_EQ(cunningham_divisor(0), 1);
  EXPECT_NEAR(brownian_diffusivity(300, 1e-3, 1e-6), 4.3948e-13, 4.3948e-13 * digits);
  EXPECT_NEAR(brownian_relevance(300, 1e-3, 1e-6, 1e-6), 0.87895, 0.87895 * digits);
}

TEST(Relevance, OfPhasesIsAShareOfWidthOrDrag) {
  EXPECT_NEAR(fluid_stress_relevance(1e-3, 1e4, 0.05), 0.012649, 0.012649 * digits);
  EXPECT_DOUBLE_EQ(species_exchange_relevance(200, 0.1, 0.02, 1e4, 0.05), 0.4 / 500);
  // Lun's k* and the dissipation of Garzo and Dufty at phi 0.3, e 0.9, evaluated apart.
  EXPECT_NEAR(conduction_length(1e-3, 0.3, 0.9), 1.692876e-3, 1.692876e-3 * digits);
}

TEST(Relevance, OfSurfacesIsTheirPull) {
  EXPECT_NEAR(van_der_waals_relevance(1e-19, 1e-7, 1), 5.2083e-9, 5.2083e-9 * digits);
  EXPECT_NEAR(capillary_relevance(0.072, 0, 1e-3, 1), 2.2619e-4, 2.2619e-4 * digits);  // 2 pi x 0.5 mm x 72 mN/m
}

// With f = 1 the balance is 18 mu u/D^2 = excess g eps: u = 1e-6 x 1500 x 9.81 eps/0.018 = 0.8175 eps m/s.
TEST(BedExpansion, BalancesDragAndWeight) {
  const CarriedBed bed{1e-3, 1500, 1000, 1e-3, 9.81};
  const auto stokes = [](double, double) { return 1.0; };
  EXPECT_NEAR(carrying_velocity(stokes, bed, 0.5), 0.40875, 1e-12);
  const auto crowded = [](double eps, double) { return 1 / (eps * eps * eps); };  // u = 0.8175 eps^4
  EXPECT_NEAR(carried_voidage(crowded, bed, 0.8175 * 0.2401, 0.4), 0.7, 1e-12);
  EXPECT_EQ(carried_voidage(crowded, bed, 0.001, 0.4), 0.4);
  EXPECT_EQ(carried_voidage(crowded, bed, 1, 0.4), 1);
}

}  // namespace
}  // namespace polybed::closures
