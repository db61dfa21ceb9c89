// Reduced quantities, restitution and the normal laws against values by hand or from the papers' tables.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "closures/contact_hertz.hpp"
#include "closures/contact_linear.hpp"
#include "closures/restitution.hpp"

namespace polybed::closures {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double round_off = 1e-14;  // relative; formulas of a few operations

TEST(ContactPair, ReducedRadiusAndMass) {
  EXPECT_NEAR(reduced_radius(3e-3, 6e-3), 2e-3, 2e-3 * round_off);
  EXPECT_NEAR(reduced_mass(4, 12), 3, 3 * round_off);
  EXPECT_DOUBLE_EQ(reduced_radius(5e-3, infinite), 5e-3);  // a wall
  EXPECT_DOUBLE_EQ(reduced_mass(infinite, .2), .2);
}

TEST(ContactPair, ReducedRadiusAtARoundWall) {
  // sqrt(1 - 0.36) = 0.8 inside a cylinder of 25/9 radii, sqrt(1 + 0.44) = 1.2 outside one of 25/11.
  EXPECT_NEAR(reduced_radius_at_wall(2e-3, 0.18e3), 2.5e-3, 2.5e-3 * round_off);
  EXPECT_NEAR(reduced_radius_at_wall(2e-3, -0.22e3), 2e-3 / 1.2, 2e-3 * round_off);
  EXPECT_DOUBLE_EQ(reduced_radius_at_wall(2e-3, 0), 2e-3);
}

TEST(ContactPair, MassOnAContact) {
  // 8 kg of twice the radius on four others; the same that is the smaller one, all on one; and either way round.
  EXPECT_DOUBLE_EQ(mass_on_a_contact(8, 2, 1, 1), 2);
  EXPECT_DOUBLE_EQ(mass_on_a_contact(1, 1, 8, 2), 2);
  EXPECT_DOUBLE_EQ(mass_on_a_contact(8, 1, 2, 2), 8);
  EXPECT_DOUBLE_EQ(mass_on_a_contact(3, 1, 3, 1), 3);
}

TEST(ContactPair, SpeedPassedOn) {
  EXPECT_DOUBLE_EQ(speed_passed_on(1, 1, 1), 1);    // equal and elastic: they change places
  EXPECT_DOUBLE_EQ(speed_passed_on(1, 1, 0), 0.5);  // they go on together
  EXPECT_DOUBLE_EQ(speed_passed_on(3, 1, 0.8), 1.35);
  EXPECT_NEAR(speed_passed_on(1e15, 1, 1), 2, 2 * 2e-15);
}

TEST(ContactPair, ReducedModuli) {
  // Glass on glass: E/(2 (1 - 0.04)) = 25 GPa; G = 20 GPa, G/(2 1.8) = 5.5556 GPa.
  const Elastic glass{48e9, .2};
  EXPECT_NEAR(reduced_youngs_modulus(glass, glass), 25e9, 25e9 * round_off);
  EXPECT_NEAR(shear_modulus(glass), 20e9, 20e9 * round_off);
  EXPECT_NEAR(reduced_shear_modulus(glass, glass), 20e9 / 3.6, 6e9 * round_off);
  // Aluminium on steel, computed apart.
  const Elastic aluminium{70e9, .33}, steel{200e9, .25};
  EXPECT_NEAR(reduced_youngs_modulus(aluminium, steel), 57413520884.16822, 1e-2);
  EXPECT_NEAR(reduced_shear_modulus(steel, aluminium), 11718521122.634325, 1e-2);
  // Rigid steel leaves the aluminium's own: 70/(1 - 0.1089) GPa.
  EXPECT_NEAR(reduced_youngs_modulus(aluminium, {infinite, .25}), 70e9 / .8911, 1e-3);
}

TEST(ContactPair, Inertia) {
  EXPECT_DOUBLE_EQ(moment_of_inertia(2, .1), 8e-3);  // m D^2/10
}

TEST(Restitution, DampingRatioOfTheClippedLaw) {
  // Six printed decimals, from integrations of both laws.
  const std::array<std::pair<double, double>, 7> table{
      {{.95, .016498}, {.9, .034265}, {.8, .074355}, {.7, .122215}, {.5, .255276}, {.3, .497239}, {.1, 1.243188}}};
  for (const auto& [e, beta] : table) {
    EXPECT_NEAR(damping_ratio_clipped(e), beta, 5.1e-7) << e;
    EXPECT_NEAR(restitution_clipped(damping_ratio_clipped(e)), e, 1e-14);
  }
  EXPECT_EQ(damping_ratio_clipped(1), 0);
  EXPECT_EQ(damping_ratio_clipped(.01), damping_ratio_clipped(.05));
}

TEST(Restitution, WhatTheUncorrectedRatioGivesWhenClipped) {
  const std::array<std::pair<double, double>, 3> table{{{.9, .90203}, {.7, .71820}, {.5, .55028}}};
  for (const auto& [e, realised] : table)
    EXPECT_NEAR(restitution_clipped(damping_ratio_kept(e)), realised, 5.1e-6) << e;  // five printed decimals
}

TEST(Restitution, ClippedOnBothSidesOfOne) {
  EXPECT_EQ(restitution_clipped(0), 1);
  EXPECT_NEAR(restitution_clipped(.3), 0.45097545289312846, 1e-15);  // atan2 form, computed apart
  EXPECT_NEAR(restitution_clipped(.9), 0.1552827475016816, 1e-15);
  EXPECT_NEAR(restitution_clipped(1.5), 0.07558830936495604, 1e-15);  // logarithm form, computed apart
  EXPECT_DOUBLE_EQ(restitution_clipped(1), std::exp(-2));
  // d(ln e)/d(beta) at 1 is -4/3: no jump, no noise of cancellation.
  for (double h : {1e-14, 1e-9, 1e-6, 1e-4})
    for (double beta : {1 - h, 1 + h})
      EXPECT_NEAR(std::log(restitution_clipped(beta)), -2 - 4.0 / 3 * (beta - 1), 2 * h * h + 1e-15) << beta;
}

TEST(Restitution, KeptByHand) {
  EXPECT_EQ(damping_ratio_kept(1), 0);
  EXPECT_EQ(damping_ratio_kept(0), 1);
  // ln 0.5 = -0.6931472: 0.6931472/sqrt(9.8696044 + 0.4804530) = 0.2154538.
  EXPECT_NEAR(damping_ratio_kept(.5), .2154538, 5e-8);
}

TEST(Hertz, ForceByHand) {
  // E* 0.1 GPa, R* 2 mm, 10 um deep, m* 10 mg, beta 0.1, approach at 0.3 m/s; a = sqrt(2e-8).
  const double a = contact_radius(2e-3, 1e-5), stiffness = hertz_stiffness(1e8, a);
  EXPECT_NEAR(a, 1.4142135623730951e-4, 1e-18);
  EXPECT_NEAR(stiffness, 28284.2712474619, 1e-9);
  const double damping = hertz_damping(.1, stiffness, 1e-5);
  EXPECT_NEAR(damping, 0.0970983543414647, 1e-15);
  const NormalForce force = hertz_force(1e8, a, 1e-5, damping, -.3);
  EXPECT_NEAR(force.elastic, 0.1885618083164127, 1e-15);
  EXPECT_NEAR(force.dashpot, 0.029129506302439406, 1e-15);
  const double k = hertz_coefficient(1e8, 2e-3);
  EXPECT_NEAR(k, 5962847.939999439, 1e-8);
  EXPECT_NEAR(hertz_greatest_force(k, 1e-5), force.elastic, 1e-15);
  EXPECT_NEAR(hertz_stored_energy(k, 1e-5), 7.54247233265651e-07, 1e-21);
}

TEST(Hertz, TimeFactorIsItsGammaFunctions) {
  EXPECT_NEAR(0.8 * std::sqrt(std::numbers::pi) * std::tgamma(.4) / std::tgamma(.9), hertz_time_factor, 5.1e-11);
}

TEST(Linear, ForceByHand) {
  const double damping = linear_damping(.1, 1000, 1e-5);  // 0.2 sqrt(0.01)
  EXPECT_NEAR(damping, .02, 1e-16);
  EXPECT_NEAR(linear_contact_time(1000, 1e-5, .1), 3.157419416998276e-4, 1e-18);  // pi 1e-4/sqrt(0.99)
  EXPECT_EQ(linear_contact_time(1000, 1e-5, 1), infinite);
  EXPECT_NEAR(linear_stored_energy(1000, 1e-5), 5e-8, 1e-22);
}

}  // namespace
}  // namespace polybed::closures
