// Cohesion, rolling friction and lubrication, by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "closures/cohesion_dmt.hpp"
#include "closures/cohesion_jkr.hpp"
#include "closures/cohesion_van_der_waals.hpp"
#include "closures/contact_hertz.hpp"
#include "closures/film_impulse.hpp"
#include "closures/lubrication.hpp"
#include "closures/rolling_friction.hpp"

namespace polybed::closures {
namespace {

constexpr double work = .05, modulus = 1e7, radius = 1e-4;  // J/m2, Pa, m

/// Least force on the way apart from an overlap to the gap at which the contact ends.
template <class Force>
double greatest_pull(const Force& force, double from, double to) {
  double least = 0;
  for (int n = 0; n <= 200000; ++n) least = std::min(least, force(from + (to - from) * n / 200000));
  return -least;
}

TEST(Dmt, PullOff) {
  const double pull = dmt_pull_off(work, radius);
  EXPECT_NEAR(pull, 3.1415926535897935e-5, 1e-19);  // 2 pi 5e-6
  EXPECT_EQ(dmt_force(pull, -1e-12), 0);
  // With the Hertz force: greatest where the overlap is 0.
  const auto force = [&](double overlap) {
    return dmt_force(pull, overlap) + hertz_greatest_force(hertz_coefficient(modulus, radius), std::max(overlap, 0.0));
  };
  EXPECT_NEAR(greatest_pull(force, 1e-6, 0), pull, 1e-6 * pull);
}

TEST(Jkr, ForceAndOverlapAreThoseOfTheContactRadius) {
  // delta and F of three radii a, computed apart from the formulas in a.
  const JkrScales scales = jkr_scales(work, modulus, radius);
  EXPECT_NEAR(scales.contact_radius, 2.6978013232149173e-6, 1e-20);
  EXPECT_NEAR(jkr_force(scales, -2.1699801238394655e-07), -1.4819880743036792e-05, 1e-17);
  EXPECT_NEAR(jkr_force(scales, -1.4633272976060103e-07), -2.2966606309393445e-05, 1e-18);
  EXPECT_NEAR(jkr_force(scales, 4.395008783602073e-07), 2.1233509005374774e-05, 1e-18);
  // -(4/3) pi W R at overlap 0, -(5/6) pi W R where the neck breaks.
  EXPECT_NEAR(jkr_force(scales, 0), -4.0 / 3 * scales.force, 1e-13 * scales.force);
  EXPECT_NEAR(jkr_force(scales, -scales.gap), -5.0 / 6 * scales.force, 1e-7 * scales.force);
}

TEST(Jkr, SizeSolvesItsEquation) {
  for (double d = -1; d < 1e6; d = d < 0 ? d + 1e-3 : 1.1 * d + 1e-3) {
    const double u = jkr_size(d);
    EXPECT_NEAR(u * u * u * u - 4 * u, 3 * d, 1e-14 * (u * u * u * u + 4 * u)) << d;
    EXPECT_GE(u, 1);
  }
  EXPECT_EQ(jkr_size(-1.5), 1);
}

TEST(Jkr, PullOffIsTheLeastForceOfTheBranch) {
  const JkrScales scales = jkr_scales(work, modulus, radius);
  constexpr double pull_off = 2.356194490192345e-5;  // 1.5 pi W R* = 1.5 pi 5e-6
  const double pull = greatest_pull([&](double overlap) { return jkr_force(scales, overlap); }, 1e-6, -scales.gap);
  EXPECT_NEAR(pull, pull_off, 1e-6 * pull);
}

TEST(Jkr, IsHertzWhereAdhesionIsSmall) {
  // F/F_hertz - 1 falls as u^-3: 1e-9 of the work leaves 1e-4 here.
  const JkrScales scales = jkr_scales(1e-9 * work, modulus, radius);
  const double hertz = hertz_greatest_force(hertz_coefficient(modulus, radius), 1e-6);
  EXPECT_NEAR(jkr_force(scales, 1e-6), hertz, 2e-4 * hertz);
}

/// Difference quotient of an energy, and the force that it must be.
template <class Energy, class Force>
void expect_slope(const Energy& energy, const Force& force, double overlap, double step, double scale) {
  // Of second order in the step.
  const double slope = (energy(overlap + step) - energy(overlap - step)) / (2 * step);
  EXPECT_NEAR(slope, force(overlap), 1e-6 * scale) << overlap;
}

TEST(Adhesion, EnergiesAreTheIntegralsOfTheForces) {
  const JkrScales s = jkr_scales(work, modulus, radius);
  for (double d : {-.9, -.5, 0., 1., 10.})
    expect_slope([&](double x) { return jkr_energy(s, x); }, [&](double x) { return jkr_force(s, x); }, d * s.gap,
                 1e-4 * s.gap, s.force);
  EXPECT_NEAR(jkr_energy(s, -s.gap), 0, 1e-15 * s.force * s.gap);
  // 7.09 of Thornton and Ning, three figures; 7.0918 from -(4/3) (0.6 4^(1/3) + 0.1) 3 pi (pi/8)^(2/3).
  const double scale = std::cbrt(std::pow(work, 5) * std::pow(radius, 4) / (modulus * modulus));
  EXPECT_NEAR(-jkr_energy(s, 0) / scale, 7.09, 5e-3);
  const double pull = dmt_pull_off(work, radius);
  EXPECT_DOUBLE_EQ(dmt_energy(pull, 2e-6), -2e-6 * pull);
  EXPECT_EQ(dmt_energy(pull, -2e-6), 0);
  for (double overlap : {-5e-9, -1e-9, -.2e-9, 1e-8})
    expect_slope([&](double x) { return van_der_waals_energy(1e-19, 5e-8, .4e-9, -x); },
                 [&](double x) { return van_der_waals_force(1e-19, 5e-8, .4e-9, -x); }, overlap, 1e-13,
                 van_der_waals_pull_off(1e-19, 5e-8, .4e-9));
  // 1e-19 5e-8/6 over the gap: 8.3333e-19 J at 1 nm.
  EXPECT_NEAR(van_der_waals_energy(1e-19, 5e-8, .4e-9, 1e-9), -8.333333333333333e-19, 1e-32);
}

TEST(VanDerWaals, ByHand) {
  // 1e-19 5e-8/6 over the gap squared: 5.2083 nN at 0.4 nm, 0.83333 nN at 1 nm.
  EXPECT_NEAR(van_der_waals_pull_off(1e-19, 5e-8, .4e-9), 5.208333333333333e-9, 1e-22);
  EXPECT_DOUBLE_EQ(van_der_waals_force(1e-19, 5e-8, .4e-9, -1e-6), -van_der_waals_pull_off(1e-19, 5e-8, .4e-9));
  EXPECT_NEAR(van_der_waals_force(1e-19, 5e-8, .4e-9, 1e-9), -8.333333333333332e-10, 1e-23);
  EXPECT_NEAR(van_der_waals_reach(1e-19, 5e-8, 8.333333333333332e-10), 1e-9, 1e-22);
}

TEST(Rolling, ConstantTorque) {
  EXPECT_DOUBLE_EQ(rolling_limit(.1, 2e-3, 50), .01);
  EXPECT_EQ(rolling_limit(.1, 2e-3, -50), 0);
  const Vec3 moment = rolling_cdt(.01, {30, 0, -40});
  EXPECT_NEAR(moment.x, -.006, 1e-17);
  EXPECT_NEAR(moment.z, .008, 1e-17);
  EXPECT_EQ(rolling_cdt(.01, {0, 0, 0}).x, 0);
}

TEST(Rolling, SpringIsCappedAndLosesItsDashpot) {
  EXPECT_NEAR(rolling_stiffness(1e4, .2, 1e-3), 9e-4, 1e-18);  // 2.25 1e4 4e-8
  const double wall = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(rolling_inertia(.4, 1, 1, wall, wall, 1), 1.4, 1e-15);
  EXPECT_NEAR(rolling_damping(.3, 1.4, 9e-4), .6 * std::sqrt(1.26e-3), 1e-17);
  // Below the cap: 0.001 - 0.5 0.01 0.4 = -0.001, dashpot -0.002 0.4.
  const RollingMoment sticks = rolling_epsd({.001, 0, 0}, {.4, 0, 0}, .5, .002, .01, .01);
  EXPECT_NEAR(sticks.spring.x, -.001, 1e-17);
  EXPECT_NEAR(sticks.moment.x, -.0018, 1e-17);
  const RollingMoment slips = rolling_epsd({.001, 0, 0}, {.4, 0, 0}, .5, .002, .0004, .01);
  EXPECT_NEAR(slips.spring.x, -.0004, 1e-18);
  EXPECT_NEAR(slips.moment.x, -.0004, 1e-18);
}

TEST(Lubrication, ByHand) {
  // The steel sphere of 9.5 mm at 0.785 m/s in water: St* 6861.
  EXPECT_NEAR(stokes_of_impact(7780, 1000, 9.5e-3, .785, 1e-3), 6860.9, 1e-9);
  EXPECT_NEAR(stokes_of_pair(1e-6, .1, 1e-3, 1e-3), 5.305164769729845, 1e-14);  // 1/(0.06 pi)
  EXPECT_NEAR(wet_restitution(.9, 1000), 0.8690448746318098, 1e-15);            // .9 exp(-.035)
  EXPECT_EQ(wet_restitution(.9, 0), 0);
  EXPECT_NEAR(film_resistance(1e-3, 1e-3, 1e-5, 1e-4, 1e-7), 0.0018849555921538754, 1e-17);  // 6e-4 pi
  EXPECT_EQ(film_resistance(1e-3, 1e-3, 2e-4, 1e-4, 1e-7), 0);
  EXPECT_EQ(film_resistance(1e-3, 1e-3, 0, 1e-4, 1e-7), film_resistance(1e-3, 1e-3, 1e-7, 1e-4, 1e-7));
  EXPECT_NEAR(unresolved_film_resistance(1e-3, 1e-3, 1e-5, 1e-4, 1e-7), 0.0016964600329384883, 1e-17);  // 5.4e-4 pi
  EXPECT_EQ(unresolved_film_resistance(1e-3, 1e-3, 1e-4, 1e-4, 1e-7), 0);
  EXPECT_EQ(unresolved_film_resistance(1e-3, 1e-3, 1e-5, 1e-4, 2e-4), 0);  // thicker than what is resolved
}

// c = 6e-9 pi N s. From 5e-5 m to 1e-5 m: c (ln 5 - 0.4); in contact from 0 to -1e-7 m at a roughness of 1e-7 m:
// c (1 - 1e-3). Both ways, and from beyond the range, the sum of the parts.
TEST(Lubrication, ImpulseOfAFilmByHand) {
  const auto impulse = [](double before, double after) {
    return unresolved_film_impulse(1e-3, 1e-3, before, after, 1e-4, 1e-7);
  };
  EXPECT_NEAR(impulse(5e-5, 1e-5), 2.27973676e-8, 1e-16);
  EXPECT_NEAR(impulse(1e-5, 5e-5), -2.27973676e-8, 1e-16);
  EXPECT_NEAR(impulse(0, -1e-7), 1.88307064e-8, 1e-16);
  EXPECT_NEAR(impulse(3e-4, -1e-7), impulse(1e-4, 1e-6) + impulse(1e-6, 0) + impulse(0, -1e-7), 1e-22);
  EXPECT_EQ(impulse(3e-4, 1e-4), 0);
  EXPECT_EQ(unresolved_film_impulse(1e-3, 1e-3, 1e-5, 0, 1e-4, 2e-4), 0);
  // The mean resistance over a small change of the gap.
  EXPECT_NEAR(impulse(1.001e-5, 0.999e-5) / 2e-8, unresolved_film_resistance(1e-3, 1e-3, 1e-5, 1e-4, 1e-7), 1e-9);
}

}  // namespace
}  // namespace polybed::closures
