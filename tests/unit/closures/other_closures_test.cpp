// Fluids, solids stress, exchange between species: hand values, computed apart from this code.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "closures/drag_schiller_naumann.hpp"
#include "closures/fluid_properties.hpp"
#include "closures/species_exchange_syamlal.hpp"
#include "closures/stress_frictional.hpp"
#include "closures/terminal_velocity.hpp"

namespace polybed::closures {
namespace {

TEST(FluidProperties, WaterAndAir) {
  // Printed digits of the sources: Tanaka et al. 2001; Patek et al. 2009; ideal gas and Sutherland by hand.
  EXPECT_NEAR(water_density(293.15), 998.207, 5e-4);
  EXPECT_NEAR(water_viscosity(293.15), 1.00157e-3, 5e-9);
  EXPECT_NEAR(water_density(288.15), 999.103, 5e-4);
  EXPECT_NEAR(water_viscosity(288.15), 1.13755e-3, 5e-9);
  EXPECT_NEAR(air_density(293.15), 101325 / (287.05 * 293.15), 1e-12);
  EXPECT_NEAR(air_viscosity(293.15), 1.8134e-5, 5e-10);
  EXPECT_THROW((void)water_density(320), std::out_of_range);
  EXPECT_THROW((void)air_viscosity(150), std::out_of_range);
}

TEST(FrictionalStress, ValueSlopeAndTangent) {
  const FrictionalLaw law;
  // p_f(0.62) = 0.05 0.12^2 / 0.02^5 = 225000 Pa.
  EXPECT_NEAR(law(0.62).pressure, 225000, 1e-6);
  EXPECT_EQ(law(0.5).pressure, 0);
  EXPECT_EQ(law(0.3).slope, 0);
  for (double phi : {0.52, 0.58, 0.63, 0.66, 0.9}) {
    const double h = 1e-7;
    EXPECT_NEAR((law(phi + h).pressure - law(phi - h).pressure) / (2 * h), law(phi).slope, 1e-5 * law(phi).slope)
        << phi;
  }
  const double joint = law.max_packing - law.margin;
  EXPECT_NEAR(law(joint + 1e-9).slope, law(joint - 1e-9).slope, 1e-5 * law(joint).slope);
}

TEST(FrictionalStress, InverseAndPackingOfABed) {
  const FrictionalLaw law;
  for (double p : {1e-3, 1.0, 60.0, 1e5, 1e9}) EXPECT_NEAR(law(law.solids_fraction_at(p)).pressure, p, 1e-9 * p);
  FrictionalLaw bed;
  bed.max_packing = max_packing_for(0.62, 60, bed.strength, bed.onset);
  EXPECT_NEAR(bed(0.62).pressure, 60, 1e-9);
}

TEST(SpeciesExchange, HandValueSymmetryAndEqualSizes) {
  const SpeciesPair pair{1e-3, 2e-3, 2000, 1500, 0.9, 0.3};
  const double surface = 0.2 / 1e-3 + 0.1 / 2e-3;
  // g0 = 1/0.7 + 3 2e-6 250 / (0.49 3e-3) = 1.4285714 + 1.0204082
  const double g0 = radial_distribution(pair, 0.7, surface);
  EXPECT_NEAR(g0, 2.448979592, 1e-9);
  // 3 1.9 (1.5707963 + 0.3701102) 9e-6 3e6 2.4489796 0.1 / (2 pi (2e-6 + 1.2e-5)) = 831608.7; twelve digits by hand
  const double expected = 3 * 1.9 * (1.5707963267949 + 0.3 * 9.86960440108936 / 8) * 9e-6 * 3e6 * 2.44897959183673 *
                          0.1 / (6.28318530717959 * 1.4e-5);
  EXPECT_NEAR(species_exchange(pair, g0, 0.1, 0), expected, 1e-9 * expected);
  const SpeciesPair swapped{2e-3, 1e-3, 1500, 2000, 0.9, 0.3};
  EXPECT_DOUBLE_EQ(species_exchange(pair, g0, 0.1, 5), species_exchange(swapped, g0, 0.1, 5));
  EXPECT_EQ(species_exchange(pair, g0, 0, 0), 0);
}

TEST(TerminalVelocity, StokesLimitAndForceBalance) {
  const auto stokes = [](double, double) { return 1.0; };
  EXPECT_NEAR(terminal_velocity(stokes, 1e-5, 1500, 1000, 1e-3, 9.81), 1e-10 * 1500 * 9.81 / 18e-3, 1e-15);
  const auto sn = [](double eps, double re) { return DragSchillerNaumann{}(eps, re).f; };
  const double u = terminal_velocity(sn, 1e-3, 1500, 1000, 1e-3, 9.81);
  EXPECT_NEAR(18e-3 * u * sn(1, u * 1e-3 * 1000 / 1e-3) / 1e-6, 1500 * 9.81, 1e-8 * 1500 * 9.81);
  EXPECT_EQ(settling_velocity(1e-3, -1500, 1000, 1e-3, 9.81), u) << "what is lighter rises as fast";
}

}  // namespace
}  // namespace polybed::closures
