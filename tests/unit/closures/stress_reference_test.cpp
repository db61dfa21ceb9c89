// The closed forms that measured stresses are divided by, against values by hand and the literature.
#include "closures/stress_reference.hpp"

#include <gtest/gtest.h>

#include "closures/stress_ratios.hpp"

namespace polybed::closures {
namespace {

// Digits written out: 1e-6 and 1e-12 are round-off of the numbers beside them.
TEST(StressReference, NumbersOfAScene) {
  // 1395 kg/m3, 0.807 mm, 4 1/s, 1.14 mPa s: 1395 (0.807e-3)^2 4/1.14e-3 = 3.18771...
  EXPECT_NEAR(stokes_of_shear(1395, 0.807e-3, 4, 1.14e-3), 1395 * 6.51249e-7 * 4 / 1.14e-3, 1e-12);
}

TEST(StressReference, FrictionMovesJammingAndRestitution) {
  EXPECT_EQ(jamming_fraction(0), 0.636);
  EXPECT_NEAR(jamming_fraction(0.2), 0.6045, 1e-15);  // half way from 0.613 to 0.596
  EXPECT_EQ(jamming_fraction(3), 0.581);
  EXPECT_NEAR(effective_restitution(0.9, 0.3), 0.9 - 0.45 * 0.40656966, 1e-8);
  EXPECT_EQ(effective_restitution(0.9, 0), 0.9);
}

TEST(StressReference, ViscousForm) {
  const RadialValue v = viscous_stress_form(0.4, 0.585);  // (0.4/0.185)^2, 2 (0.4/0.185) 0.585/0.185^2
  EXPECT_NEAR(v.value, 4.6749452, 1e-7);
  EXPECT_NEAR(v.slope, 73.91459, 1e-4);
  EXPECT_EQ(viscous_stress_form(0, 0.585).value, 0);
  // Beyond 0.575 the tangent: C1 and finite.
  const RadialValue a = viscous_stress_form(0.575, 0.585), b = viscous_stress_form(0.7, 0.585);
  EXPECT_NEAR(b.value, a.value + 0.125 * a.slope, 1e-9 * b.value);
  EXPECT_EQ(a.slope, b.slope);
}

// Garzo and Dufty with the g0 of Carnahan and Starling: theta/(gamma d)^2 as an independent program has them, to the
// digits it gives.
TEST(StressReference, TemperatureOfSimpleShear) {
  constexpr auto gd = KineticModel::garzo_dufty;
  const auto mu = [&](double phi, double e) {
    return kinetic_viscosity(gd, phi, radial_carnahan_starling(phi).value, e);
  };
  const auto loss = [&](double phi, double e) {
    return kinetic_dissipation(gd, phi, radial_carnahan_starling(phi).value, e);
  };
  EXPECT_NEAR(shear_temperature(mu(0.2, 0.9), loss(0.2, 0.9)), 2.0245, 1e-4);
  EXPECT_NEAR(shear_temperature(mu(0.4, 0.99), loss(0.4, 0.99)), 10.1709, 1e-4);
  // With drag: mu* s = Gamma* s^3 + 3 phi r s^2, r = 1/(gamma tau_d).
  const auto with_drag = [&](double rate) {
    const double s = balanced_speed(loss(0.4, 0.9), 3 * 0.4 * rate, mu(0.4, 0.9), 0);
    return s * s;
  };
  EXPECT_NEAR(with_drag(0.1), 0.848, 5e-4);
  EXPECT_NEAR(with_drag(1), 0.2324, 5e-5);
  EXPECT_NEAR(with_drag(10), 0.004, 5e-4);
  EXPECT_NEAR(with_drag(0), shear_temperature(mu(0.4, 0.9), loss(0.4, 0.9)), 1e-12);
}

RatioCurves level(double stokes, double p, double mu) {
  const std::vector<double> phi{0.2, 0.4};
  return {stokes, {phi, {p, p}}, {phi, {mu, mu}}, {phi, {1, 1}}};
}

TEST(StressRatios, LinearInTheLogarithmOfStokesAndHeldBeyond) {
  const StressRatios ratios({level(1, 2, 3), level(100, 4, 5)});
  EXPECT_NEAR(ratios(0.3, 10).pressure.pressure, 3, 1e-12);  // half way in ln St
  EXPECT_NEAR(ratios(0.3, 10).viscosity.pressure, 4, 1e-12);
  EXPECT_EQ(ratios(0.3, 0).pressure.pressure, 2);
  EXPECT_EQ(ratios(0.3, 1e6).pressure.pressure, 4);
  EXPECT_FALSE(ratios.outside(0.3, 10));
  EXPECT_TRUE(ratios.outside(0.1, 10));
  EXPECT_TRUE(ratios.outside(0.3, 0.5));
  EXPECT_FALSE(StressRatios({level(0, 1, 1)}).outside(0.3, 0.5)) << "a dry table has no Stokes number";
}

// mu gamma (1 + 0.5 2) V(0.4) 2 with V = 4.6749452: 1e-3 5 2 4.6749452 2 = 0.0934989 Pa; mu_s 1e-3 2 4.6749452 3.
TEST(StressRatios, WetStressByHand) {
  const StressRatios ratios({level(1, 2, 3)});
  const WetStress s = wet_stress(ratios, 0.585, 0.5, 0.4, 2, 1e-3, 5);
  EXPECT_NEAR(s.pressure, 0.093498904, 1e-8);
  EXPECT_NEAR(s.viscosity, 0.028049671, 1e-8);
  constexpr double h = 1e-6;  // a central difference of it, to its second order
  const double difference = (wet_stress(ratios, 0.585, 0.5, 0.4 + h, 2, 1e-3, 5).pressure -
                             wet_stress(ratios, 0.585, 0.5, 0.4 - h, 2, 1e-3, 5).pressure) /
                            (2 * h);
  EXPECT_NEAR(s.slope, difference, 1e-6 * s.slope);
}

}  // namespace
}  // namespace polybed::closures
