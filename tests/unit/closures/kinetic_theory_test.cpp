// Kinetic theory and frictional viscosity against values computed apart from this code.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "closures/frictional_viscosity.hpp"
#include "closures/kinetic_theory.hpp"

namespace polybed::closures {
namespace {

constexpr KineticModel lun = KineticModel::lun, garzo_dufty = KineticModel::garzo_dufty;

TEST(RadialDistribution, CarnahanStarlingAndTorquato) {
  // (1 - phi/2)/(1 - phi)^3 by hand, four printed digits.
  const std::array<double, 5> expected{1.3032, 1.7578, 2.4781, 3.7037, 6.0};
  for (std::size_t n = 0; n < expected.size(); ++n)
    EXPECT_NEAR(radial_carnahan_starling(0.1 * double(n + 1)).value, expected[n], 5e-5);
  // CS(0.49) = 0.755/0.51^3 = 5.691627; times 0.15/(0.64 - 0.55) = 9.486045.
  EXPECT_NEAR(radial_distribution_dense(0.49).value, 5.691627, 1e-6);
  EXPECT_NEAR(radial_distribution_dense(0.55).value, 9.486045, 1e-6);
  EXPECT_EQ(radial_distribution_dense(0.3).value, radial_carnahan_starling(0.3).value);
}

TEST(RadialDistribution, SlopesAndTheTangentBeyondJamming) {
  for (double phi : {0.05, 0.3, 0.48, 0.5, 0.6, 0.634, 0.64, 0.8}) {
    constexpr double h = 1e-6;  // the difference is right to h^2 times the third derivative, below 1e-5 relative
    const double difference =
        (radial_distribution_dense(phi + h).value - radial_distribution_dense(phi - h).value) / (2 * h);
    EXPECT_NEAR(difference, radial_distribution_dense(phi).slope, 1e-5 * radial_distribution_dense(phi).slope) << phi;
  }
  EXPECT_NEAR(radial_distribution_dense(0.635 + 1e-9).value, radial_distribution_dense(0.635 - 1e-9).value, 1e-3);
}

TEST(RadialDistribution, OfPairsIsCarnahanStarlingForOneSize) {
  for (double phi : {0.01, 0.2, 0.5})  // the same polynomial: round-off
    EXPECT_NEAR(radial_of_pair(1 - phi, phi / 1e-3, 1e-3, 1e-3), radial_carnahan_starling(phi).value, 1e-13);
  // 1 and 2 mm, 0.2 of each: xi = 300 /m; computed apart from xi = (pi/6) sum n D^2.
  EXPECT_NEAR(radial_of_pair(0.6, 300, 1e-3, 1e-3), 3.125, 1e-12);
  EXPECT_NEAR(radial_of_pair(0.6, 300, 1e-3, 2e-3), 3.70370370370370, 1e-12);
  EXPECT_NEAR(radial_of_pair(0.6, 300, 2e-3, 2e-3), 5.0, 1e-12);
}

/// Steady simple shear, theta, p, mu in units of rho, D and the shear rate, with a drag sink of rate 1/tau_d.
struct Shear {
  double theta, p, mu;
};

Shear shear(KineticModel model, double phi, double e, double drag_rate) {
  const double g0 = radial_carnahan_starling(phi).value;
  const double viscosity = kinetic_viscosity(model, phi, g0, e);
  const double s =
      balanced_speed(kinetic_dissipation(model, phi, g0, e), fluctuation_drag_sink(phi * drag_rate, 1), viscosity, 0);
  return {s * s, kinetic_pressure(phi, g0, e) * s * s, viscosity * s};
}

struct ShearRow {
  double phi, e;
  Shear lun, garzo_dufty;
};

class SimpleShear : public testing::TestWithParam<ShearRow> {};

TEST_P(SimpleShear, HasTheTabledTemperaturePressureAndViscosity) {
  const ShearRow& row = GetParam();
  const auto expect = [&](const Shear& is, const Shear& expected) {
    EXPECT_NEAR(is.theta, expected.theta, 5.1e-5);  // four printed decimals
    EXPECT_NEAR(is.p, expected.p, 5.1e-5);
    EXPECT_NEAR(is.mu, expected.mu, 5.1e-5);
  };
  expect(shear(lun, row.phi, row.e, 0), row.lun);
  expect(shear(garzo_dufty, row.phi, row.e, 0), row.garzo_dufty);
}

INSTANTIATE_TEST_SUITE_P(Table, SimpleShear,
                         testing::Values(ShearRow{.1, .7, {2.3031, .3324, .1573}, {2.5564, .3689, .1840}},
                                         ShearRow{.3, .7, {.3771, .3991, .1783}, {.3959, .4190, .1919}},
                                         ShearRow{.5, .7, {.2723, 1.5249, .7360}, {.2783, 1.5586, .7607}},
                                         ShearRow{.1, .9, {6.5969, .9864, .2840}, {6.8577, 1.0254, .3002}},
                                         ShearRow{.2, .9, {1.9655, .9183, .2492}, {2.0245, .9458, .2598}},
                                         ShearRow{.3, .9, {1.2103, 1.3888, .3820}, {1.2364, 1.4188, .3933}},
                                         ShearRow{.4, .9, {.9773, 2.5916, .7365}, {.9933, 2.6340, .7525}},
                                         ShearRow{.5, .9, {.8834, 5.4770, 1.6021}, {.8953, 5.5506, 1.6300}},
                                         ShearRow{.2, .95, {3.9759, 1.8854, .3680}, {4.0379, 1.9149, .3759}},
                                         ShearRow{.4, .95, {1.9958, 5.4107, 1.1029}, {2.0138, 5.4595, 1.1158}},
                                         ShearRow{.4, .99, {10.1511, 28.0019, 2.5822}, {10.1709, 28.0565, 2.5886}}));

TEST(SimpleShearWithDrag, HasTheTabledValues) {
  // phi 0.4, e 0.9, 1/(gamma tau_d) = 0.1, 1, 10: printed decimals.
  const Shear weak = shear(garzo_dufty, .4, .9, .1), even = shear(garzo_dufty, .4, .9, 1),
              strong = shear(garzo_dufty, .4, .9, 10);
  EXPECT_NEAR(weak.theta, .848, 5.1e-4);
  EXPECT_NEAR(weak.p, 2.249, 5.1e-4);
  EXPECT_NEAR(weak.mu, .695, 5.1e-4);
  EXPECT_NEAR(even.theta, .2324, 5.1e-5);
  EXPECT_NEAR(even.p, .616, 5.1e-4);
  EXPECT_NEAR(even.mu, .364, 5.1e-4);
  EXPECT_NEAR(strong.theta, .004, 5.1e-4);
  EXPECT_NEAR(strong.p, .010, 5.1e-4);
  EXPECT_NEAR(strong.mu, .047, 5.1e-4);
}

TEST(KineticTheory, CoolsAfterHaff) {
  // dtheta/dt = -(2/3) Gamma/(phi rho) = -(2/t_H) theta at theta_0: phi .2, e .9, D 1 mm, theta_0 .01: t_H 66.337 ms.
  const double star = kinetic_dissipation(lun, .2, radial_carnahan_starling(.2).value, .9);
  EXPECT_NEAR(2 / (2.0 / 3 * star / .2 * std::sqrt(.01) / 1e-3), 66.337e-3, 5e-7);
}

TEST(KineticTheory, Conductivity) {
  // Written out apart: phi .3, g0 2.478134, e .9. Dilute and elastic: 75 sqrt(pi)/384.
  EXPECT_NEAR(kinetic_conductivity(.3, radial_carnahan_starling(.3).value, .9), 1.2299336202, 1e-9);
  EXPECT_NEAR(kinetic_conductivity(0, 1, 1), 0.34618239275, 1e-10);
  EXPECT_NEAR(viscosity_lun(0, 1, 1), 0.0923153, 1e-7);  // 5 sqrt(pi)/96
  EXPECT_NEAR(viscosity_garzo_dufty(0, 1, 1), 0.0923153, 1e-7);
}

TEST(KineticTheory, PressureOfAMixture) {
  // 1 and 2 mm, 2500 kg/m3, 0.2 of each, theta 0.01 and 0.005, e 0.9: the symmetric double sum, computed apart.
  const std::array<double, 2> d{1e-3, 2e-3}, theta{0.01, 0.005};
  double pressure = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    double collisions = 1;
    for (std::size_t j = 0; j < 2; ++j)
      collisions += mixture_pressure_of_pair(0.2, radial_of_pair(0.6, 300, d[i], d[j]), 0.9, d[i], d[j],
                                             std::pow(d[i] / d[j], 3));
    pressure += 0.2 * 2500 * theta[i] * collisions;
  }
  EXPECT_NEAR(pressure, 44.7083333333, 1e-9);
  EXPECT_NEAR(1 + mixture_pressure_of_pair(0.3, 2, 0.9, 1e-3, 1e-3, 1), kinetic_pressure(0.3, 2, 0.9) / 0.3, 1e-14);
}

TEST(KineticTheory, SlipProduction) {
  // 81 0.3 (1.8e-5)^2 0.5^2/(2.478134 (5e-4)^3 2500 sqrt(pi)), by hand.
  EXPECT_NEAR(slip_production(.3, radial_carnahan_starling(.3).value, 1.8e-5, .5, 5e-4, 2500), 1.43397483e-3, 1e-11);
}

TEST(KineticTheory, BalancedSpeedSolvesItsEquation) {
  for (double a : {1e-3, 1.0, 1e4})
    for (double b : {-10.0, 0.0, 3.0, 1e6})
      for (double p : {0.0, 1e-4, 2.0, 1e5})
        for (double c : {0.0, 1e-9, 1.0}) {
          const double s = balanced_speed(a, b, p, c);
          if (p == 0 && c == 0) {
            EXPECT_EQ(s, b < 0 ? -b / a : 0);
            continue;
          }
          EXPECT_GT(s, 0);
          const double largest = std::max({a * s * s * s * s, std::abs(b) * s * s * s, p * s * s, c});
          EXPECT_NEAR(((a * s + b) * s - p) * s * s - c, 0, 1e-12 * largest) << a << " " << b << " " << p << " " << c;
        }
}

// Both sides of every size of the terms, each over sixteen powers of ten: seven steps always suffice.
TEST(KineticTheory, BalancedSpeedReachesRoundOffFromItsStart) {
  std::mt19937_64 draw(1);
  const auto power = [&](double range) { return std::pow(10.0, std::uniform_real_distribution(-range, range)(draw)); };
  for (int n = 0; n < 20000; ++n) {
    const double a = power(4), b = (n % 4 == 0 ? -1 : 1) * power(8), p = power(8), c = power(8);
    const double s = balanced_speed(a, b, p, c),
                 largest = std::max({a * s * s * s * s, std::abs(b) * s * s * s, p * s * s, c});
    EXPECT_NEAR(((a * s + b) * s - p) * s * s - c, 0, 1e-13 * largest) << a << " " << b << " " << p << " " << c;
  }
}

TEST(KineticTheory, BalancedSpeedFallsAsItsFormulaSays) {
  EXPECT_DOUBLE_EQ(fall_of_balanced_speed(2, 2, 1, 1), 1.0 / 7);  // 2 + 1 = 2 + 1: 1/(4*2 + 3*1 - 2*2), by hand
  EXPECT_EQ(fall_of_balanced_speed(2, 0, 0, 0), 0);
  for (const double b : {-10.0, 0.0, 3.0})
    for (const double p : {1e-4, 2.0})
      for (const double c : {0.0, 1.0}) {
        constexpr double change = 1e-5;  // the central difference is off by its square, the roots by 1e-13 over it
        const double s = balanced_speed(1, b, p, c);
        const double slope = (balanced_speed(1, b - change, p, c) - balanced_speed(1, b + change, p, c)) / (2 * change);
        EXPECT_NEAR(fall_of_balanced_speed(1, p, c, s), slope, 1e-5 * slope) << b << " " << p << " " << c;
      }
}

TEST(KineticTheory, RootBoundIsAboveTheRootByAtMostSixPercent) {
  for (double power : {1.0 / 3, 0.25})
    for (double x = 1e-290; x < 1e290; x *= 1.0173) {  // 1.0612, 1.0583 are the largest of a mantissa for its logarithm
      EXPECT_GE(root_bound(x, power), std::pow(x, power)) << x;
      EXPECT_LE(root_bound(x, power), 1.062 * std::pow(x, power)) << x;
    }
}

TEST(Walls, JohnsonAndJacksonByHand) {
  // pi sqrt(0.03) 0.1 2500 0.5 6/(6 0.64); with |U_t| 0.2, e_w 0.9: [0.1 0.04/6 - 0.19 0.01/4].
  EXPECT_NEAR(wall_collisions(.01, .1, 2500, .5, 6, .64), 106.277306498, 1e-8);
  EXPECT_NEAR(wall_energy(.01, .1, .9, .2, 2500, .5, 6, .64), 1.22218902471, 1e-10);
  EXPECT_EQ(wall_collisions(-1e-9, .1, 2500, .5, 6, .64), 0);  // an undershoot of the temperature
  EXPECT_NEAR(wall_friction(100, .2, .5, 1e-3), 40, 1e-4);     // 100 0.2/0.5; the rounding is 2e-6 of it
  EXPECT_NEAR(wall_friction(100, .2, 0, 1e-3), 2e4, 1e-8);     // 100 0.2/1 mm/s
}

TEST(FrictionalViscosity, SchaefferAndItsCap) {
  // 1000 sin(30 deg)/10 = 50; |gamma| of 3 and a least rate of 4 is 5.
  EXPECT_NEAR(viscosity_schaeffer(1000, .5, 10, 100), 50, 1e-12);
  EXPECT_EQ(viscosity_schaeffer(1000, .5, 1, 100), 100);
  EXPECT_EQ(viscosity_schaeffer(-5, .5, 1, 100), 0);
  EXPECT_DOUBLE_EQ(shear_rate(9, 4), 5);
}

TEST(FrictionalViscosity, MuOfI) {
  const InertialFriction friction;
  EXPECT_DOUBLE_EQ(friction(0), .38);
  EXPECT_DOUBLE_EQ(friction(.28), .51);
  EXPECT_NEAR(friction(1e9), .64, 1e-9);
  // D 1 mm, 10 /s, 400 Pa, 2500 kg/m3: I = 0.025, mu = 0.38 + 0.26/12.2 = 0.40131148; times 400/10.
  EXPECT_NEAR(viscosity_mu_i(friction, 400, 10, 1e-3, 2500, 1e9), 16.0524590, 1e-7);
  EXPECT_EQ(viscosity_mu_i(friction, 0, 10, 1e-3, 2500, 1e9), 0);
  EXPECT_EQ(viscosity_mu_i(friction, 400, 10, 1e-3, 2500, 5), 5);
}

}  // namespace
}  // namespace polybed::closures
