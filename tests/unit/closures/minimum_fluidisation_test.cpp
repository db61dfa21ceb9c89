#include "closures/minimum_fluidisation.hpp"

#include <gtest/gtest.h>

#include "closures/bed_expansion.hpp"
#include "closures/drag_carman_kozeny.hpp"
#include "closures/pressure_drop.hpp"

namespace polybed::closures {
namespace {

// 1 mm, 1500 kg/m3 heavier than a liquid of 1000 kg/m3 and 1 mPa s: Ar = 14715, Re_mf = sqrt(1135.69 + 600.372) - 33.7
// = 7.966077. Of very small spheres it is 0.0408 Ar/67.4, without loss of digits.
TEST(MinimumFluidisation, OfWenAndYuByHand) {
  EXPECT_NEAR(minimum_fluidisation(1e-3, 1500, 1000, 1e-3, 9.81), 7.966077e-3, 1e-9);
  EXPECT_EQ(minimum_fluidisation(1e-3, -1500, 1000, 1e-3, 9.81), minimum_fluidisation(1e-3, 1500, 1000, 1e-3, 9.81));
  const double archimedes = 1.5 * 9.81 * 1e-21 / 1e-12;
  EXPECT_NEAR(minimum_fluidisation(1e-7, 1500, 1000, 1e-3, 9.81) / (archimedes * 0.0408 / 67.4 * 10), 1, 1e-8);
}

// Carman and Kozeny: 180 mu u phi^2/(eps^3 D^2) = 180 1e-3 1e-3 0.36/(0.064 1e-6) = 1012.5 Pa/m. At the balance of
// drag and weight the gradient is phi (rho_s - rho_f) g.
TEST(PressureGradient, OfAPackedBedByHand) {
  const auto drag = [](double eps, double re) { return DragCarmanKozeny{}(eps, re).f; };
  const CarriedBed bed{1e-3, 1500, 1000, 1e-3, 9.81};
  EXPECT_NEAR(pressure_gradient(drag, bed, 0.4, 1e-3), 1012.5, 1e-9);
  const double balance = carrying_velocity(drag, bed, 0.4);
  EXPECT_NEAR(pressure_gradient(drag, bed, 0.4, balance), 0.6 * 1500 * 9.81, 1e-9);
}

/// 54 mm at 40 - 13 mm/s.
TEST(RisingTime, OfAPlugByHand) { EXPECT_NEAR(rising_time(0.054, 0.040, 0.013), 2, 1e-14); }

}  // namespace
}  // namespace polybed::closures
