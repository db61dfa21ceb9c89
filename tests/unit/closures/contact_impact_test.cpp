// One impact, integrated with the contact laws, against the set-ups of Chung and Ooi (Granular Matter 13, 2011, 643)
// and of MFiX: closed forms, and tables computed elsewhere with 20000 steps per contact.
#include "contact_impact.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "closures/contact_linear.hpp"
#include "closures/restitution.hpp"

namespace polybed::closures::impact {
namespace {

constexpr Elastic rigid{std::numeric_limits<double>::infinity(), .3};

double mass_of(double radius, double density) {
  return 4.0 / 3 * std::numbers::pi * radius * radius * radius * density;
}

/// Sphere on a rigid plane.
Sphere on_plane(const Elastic& material, double radius, double density) {
  return {mass_of(radius, density), radius, reduced_youngs_modulus(material, rigid),
          reduced_shear_modulus(material, rigid)};
}

struct ElasticRow {
  const char* name;
  Sphere sphere;
  double speed, overlap, force, time;
};

std::array<ElasticRow, 7> chung_and_ooi() {
  const auto pair = [](const Elastic& material, double radius, double density) {
    return Sphere{reduced_mass(mass_of(radius, density), mass_of(radius, density)), reduced_radius(radius, radius),
                  reduced_youngs_modulus(material, material), reduced_shear_modulus(material, material)};
  };
  return {{{"1 glass", pair({48e9, .20}, .01, 2800), 20, 2.741127e-4, 1.069689e4, 4.033946e-5},
           {"1 limestone", pair({20e9, .25}, .01, 2500), 20, 3.683040e-4, 7.108241e3, 5.420100e-5},
           {"2 aluminium", on_plane({70e9, .30}, .1, 2699), .2, 4.971718e-5, 1.136986e4, 7.316566e-4},
           {"2 magnesium", on_plane({40e9, .35}, .1, 1800), .2, 5.212329e-5, 7.232681e3, 7.670659e-4},
           {"3 alumina", on_plane({380e9, .23}, 2.5e-3, 4000), 3.9, 8.088808e-6, 6.153516e2, 6.104510e-6},
           {"3 cast iron", on_plane({100e9, .25}, 2.5e-3, 7000), 3.9, 1.718871e-5, 5.067602e2, 1.297208e-5},
           {"5 steel", on_plane({208e9, .3}, 1e-5, 7850), 5, 6.473498e-8, 1.587337e-2, 3.810657e-8}}};
}

TEST(ElasticImpact, ClosedFormsAreTheTabled) {
  for (const ElasticRow& row : chung_and_ooi()) {
    const double k = hertz_coefficient(row.sphere.youngs_modulus, row.sphere.radius);
    const double overlap = hertz_greatest_overlap(k, row.sphere.mass, row.speed);
    EXPECT_NEAR(overlap, row.overlap, 5e-7 * row.overlap) << row.name;  // half a unit of seven figures
    EXPECT_NEAR(hertz_greatest_force(k, overlap), row.force, 5e-7 * row.force) << row.name;
    EXPECT_NEAR(hertz_contact_time(overlap, row.speed), row.time, 5e-7 * row.time) << row.name;
    // All the energy of the impact is in the spring then.
    EXPECT_NEAR(hertz_stored_energy(k, overlap) / (0.5 * row.sphere.mass * row.speed * row.speed), 1, 1e-14);
  }
}

TEST(ElasticImpact, WithAHundredStepsPerContact) {
  for (const ElasticRow& row : chung_and_ooi()) {
    const Rebound out = collide(row.sphere, {0, -row.speed}, row.time / 100);
    // Second order: 5e-5 of the overlap and the time, 7e-5 of the force; 1e-4 is asked for.
    EXPECT_NEAR(out.overlap, row.overlap, 1e-4 * row.overlap) << row.name;
    EXPECT_NEAR(out.force, row.force, 1e-4 * row.force) << row.name;
    EXPECT_NEAR(out.time, row.time, 1e-4 * row.time) << row.name;
  }
}

/// Largest error of the realised restitution over the phase of contact.
double error_of_restitution(double e, int steps, bool clipped) {
  Sphere sphere = on_plane({380e9, .23}, 2.5e-3, 4000);
  sphere.beta = clipped ? damping_ratio_clipped(e) : damping_ratio_kept(e);
  sphere.clipped = clipped;
  const double speed = 3.9, dt = elastic_time(sphere, speed) / steps;
  double largest = 0;
  for (int phase = 0; phase < 100; ++phase) {
    const Rebound out = collide(sphere, {-speed * dt * phase / 100, -speed}, dt);
    largest = std::max(largest, std::abs(out.motion.v_n / speed - e));
  }
  return largest;
}

TEST(DampedImpact, RestitutionIsAsAccurateAsTabled) {
  constexpr std::array<double, 4> restitution{1, .9, .7, .5};
  constexpr std::array<int, 4> steps{10, 20, 50, 100};
  constexpr double table[4][4] = {{2.6e-3, 1.05e-2, 1.6e-2, 2.4e-2},
                                  {4.3e-4, 2.0e-3, 6.3e-3, 1.1e-2},
                                  {4.1e-5, 7.7e-4, 2.4e-3, 4.4e-3},
                                  {7.2e-6, 1.6e-4, 5.5e-4, 1.3e-3}};
  for (std::size_t n = 0; n < 4; ++n)
    for (std::size_t k = 0; k < 4; ++k) {
      const double kept = error_of_restitution(restitution[k], steps[n], false);
      EXPECT_LT(kept, 1.5 * table[n][k]) << steps[n] << " " << restitution[k];
      EXPECT_GT(kept, table[n][k] / 1.5) << steps[n] << " " << restitution[k];
      // Clipped, the force ends with a jump of its slope: as accurate but for a factor.
      EXPECT_LT(error_of_restitution(restitution[k], steps[n], true), 2 * table[n][k]);
    }
  for (double e : restitution)  // second order without damping, first with it
    EXPECT_GT(error_of_restitution(e, 20, false), (e == 1 ? 25 : 5) * error_of_restitution(e, 100, false)) << e;
}

TEST(DampedImpact, EveryRestitutionComesOut) {
  // Test 3 of Chung and Ooi; 100 steps per contact, the accuracy above.
  for (double e : {.2, .4, .6, .8, 1.0})
    for (bool clipped : {false, true}) EXPECT_LT(error_of_restitution(e, 100, clipped), 4e-3) << e;
}

// Oblique impacts.

constexpr double degree = std::numbers::pi / 180;

/// Test 4: alumina, 3.9 m/s at an angle from the normal.
Rebound oblique(Law law, double angle, int steps, bool shortened_arm, double phase = 0, bool whole_first_step = false) {
  Sphere sphere = on_plane({380e9, .23}, 2.5e-3, 4000);
  sphere.beta = damping_ratio_clipped(.98);
  sphere.friction = .092;
  sphere.law = law;
  sphere.shortened_arm = shortened_arm;
  sphere.whole_first_step = whole_first_step;
  const double v_n = 3.9 * std::cos(angle * degree), v_t = 3.9 * std::sin(angle * degree);
  const double dt = elastic_time(sphere, v_n) / steps;
  Rebound out = collide(sphere, {-v_n * dt * phase, -v_n, v_t}, dt);
  out.motion.v_t /= v_t;
  return out;
}

constexpr std::array<double, 7> angles{2, 5, 10, 15, 20, 25, 30};
constexpr std::array<double, 7> hdd_table{.75034, .69448, .57356, .56197, .58213, .62263, .68474};
constexpr std::array<double, 7> mindlin_table{.87033, .85746, .70669, .63385, .62248, .63937, .68474};
constexpr std::array<double, 7> hdd_spin{33.98, 103.85, 288.80, 442.15, 557.39, 621.99, 614.75};

TEST(ObliqueImpact, SticksAsTabled) {
  // The table was computed with the lever arm R; 20000 steps and five printed decimals.
  for (std::size_t n = 0; n < angles.size(); ++n) {
    const Rebound hdd = oblique(Law::hdd, angles[n], 20000, false);
    EXPECT_NEAR(hdd.motion.v_t, hdd_table[n], 2e-5) << angles[n];
    EXPECT_NEAR(-hdd.motion.spin, hdd_spin[n], .02) << angles[n];
    EXPECT_NEAR(oblique(Law::mindlin, angles[n], 20000, false).motion.v_t, mindlin_table[n], 2e-5) << angles[n];
  }
  EXPECT_NEAR(oblique(Law::hdd_full, 5, 20000, false).motion.v_t, .96411, 2e-5);
}

TEST(ObliqueImpact, SticksAsTabledWith200Steps) {
  // The arm R - delta takes up to 4e-3 from the ratio and 200 steps give up to 7e-3 (at 10 degrees): 5e-3 is asked for.
  for (std::size_t n = 0; n < angles.size(); ++n) {
    EXPECT_NEAR(oblique(Law::hdd, angles[n], 200, true).motion.v_t, hdd_table[n], 5e-3) << angles[n];
    EXPECT_NEAR(oblique(Law::mindlin, angles[n], 200, true).motion.v_t, mindlin_table[n], 5e-3) << angles[n];
  }
}

TEST(ObliqueImpact, ConvergesWithTheStep) {
  // Against 20000 steps and the same arm; slowest at 10 degrees, where it goes from sliding to sticking: 7.1e-3, 2.9e-3
  // at 200 and 800 steps.
  for (Law law : {Law::hdd, Law::mindlin})
    for (double angle : angles) {
      const double fine = oblique(law, angle, 20000, false).motion.v_t;
      EXPECT_NEAR(oblique(law, angle, 200, false).motion.v_t, fine, angle == 10 ? 8e-3 : 5e-3) << angle;
      EXPECT_NEAR(oblique(law, angle, 800, false).motion.v_t, fine, 5e-3) << angle;
    }
}

TEST(ObliqueImpact, DoesNotDependOnThePhaseOfTheFirstStep) {
  double largest = 0, naive = 0;
  for (double angle : {2.0, 5.0})
    for (int phase = 0; phase < 50; ++phase) {
      const double fine = oblique(Law::hdd, angle, 20000, false).motion.v_t;
      largest = std::max(largest, std::abs(oblique(Law::hdd, angle, 200, false, phase / 50.0).motion.v_t - fine));
      naive = std::max(naive, std::abs(oblique(Law::hdd, angle, 200, false, phase / 50.0, true).motion.v_t - fine));
    }
  EXPECT_LT(largest, 5e-4);  // 2.6e-4 was measured
  EXPECT_GT(naive, 2e-2);    // the whole first step: 3.4e-2
}

TEST(ObliqueImpact, GrossSlidingIsExact) {
  for (Law law : {Law::hdd, Law::hdd_full, Law::mindlin, Law::mindlin_deresiewicz})
    for (double angle : {40.0, 50.0, 60.0, 75.0}) {
      const Rebound out = oblique(law, angle, 200, true);
      const double impulse = .092 * 1.98 * 3.9 * std::cos(angle * degree);
      EXPECT_NEAR(out.motion.v_t, 1 - impulse / (3.9 * std::sin(angle * degree)), 5e-5) << angle;
      EXPECT_NEAR(-out.motion.spin, 2.5 * impulse / 2.5e-3, 5e-3 * 2.5 * impulse / 2.5e-3) << angle;  // arm R - delta
    }
  // Printed in the source of the set-up.
  EXPECT_NEAR(oblique(Law::hdd, 40, 200, true).motion.v_t, .78291, 5e-5);
  EXPECT_NEAR(oblique(Law::hdd, 75, 200, true).motion.v_t, .95119, 5e-5);
}

TEST(ObliqueImpact, GivesNoEnergy) {
  // Elastic in n: of the energy along the plane some is lost or none.
  Sphere sphere = on_plane({380e9, .23}, 2.5e-3, 4000);
  sphere.friction = .092;
  sphere.shortened_arm = false;
  for (Law law : {Law::hdd, Law::mindlin, Law::mindlin_deresiewicz})
    for (double v_t : {.05, .2, .5, 1.0, 2.0, 4.0}) {
      sphere.law = law;
      const Motion out = collide(sphere, {0, -3.9, v_t}, elastic_time(sphere, 3.9) / 200).motion;
      EXPECT_LT(out.v_t * out.v_t + .4 * 2.5e-3 * 2.5e-3 * out.spin * out.spin, v_t * v_t) << v_t;
    }
}

TEST(ObliqueImpact, PartialSlipConvergesAndLiesBetweenTheOtherLaws) {
  for (double angle : {5.0, 10.0, 15.0, 20.0, 25.0}) {
    const double fine = oblique(Law::mindlin_deresiewicz, angle, 20000, false).motion.v_t;
    EXPECT_NEAR(oblique(Law::mindlin_deresiewicz, angle, 200, false).motion.v_t, fine, 5e-3) << angle;
    EXPECT_GT(fine, oblique(Law::hdd, angle, 20000, false).motion.v_t) << angle;
    EXPECT_LT(fine, oblique(Law::mindlin, angle, 20000, false).motion.v_t) << angle;
  }
}

TEST(ObliqueImpact, OfSteelWithoutDamping) {
  // Test 5: 2 (1 - nu) v_c'/(mu (2 - nu) v_n) over v_t/v_n; lever arm R as in the table.
  constexpr std::array<double, 7> ratio{.1, .2, .5, 1, 1.5, 2, 3};
  constexpr std::array<double, 7> hdd{.0028, -.0531, -.6496, -1.5346, -1.4589, -.2745, 2.4706};
  constexpr std::array<double, 7> mindlin{.1401, .2643, .1030, -.9627, -1.1823, -.2745, 2.4706};
  const auto leaves = [&](Law law, double v_t, int steps) {
    Sphere sphere = on_plane({208e9, .3}, 1e-5, 7850);
    sphere.friction = .3;
    sphere.law = law;
    sphere.shortened_arm = false;
    const Rebound out = collide(sphere, {0, -5, v_t}, elastic_time(sphere, 5) / steps);
    return 2 * (1 - .3) * (out.motion.v_t + 1e-5 * out.motion.spin) / (.3 * (2 - .3) * 5);
  };
  for (std::size_t n = 0; n < ratio.size(); ++n) {
    EXPECT_NEAR(leaves(Law::hdd, 5 * ratio[n], 20000), hdd[n], 1.1e-4) << ratio[n];  // four printed decimals
    EXPECT_NEAR(leaves(Law::mindlin, 5 * ratio[n], 20000), mindlin[n], 1.1e-4) << ratio[n];
    EXPECT_NEAR(leaves(Law::hdd, 5 * ratio[n], 200), hdd[n], 5e-3) << ratio[n];
    // Of first order, as the stiffness is that of the step's end: 5.1e-3 with 200 steps at v_t/v_n 0.2.
    EXPECT_NEAR(leaves(Law::mindlin, 5 * ratio[n], 400), mindlin[n], 5e-3) << ratio[n];
  }
}

/// Test 6: aluminium, e 0.5, friction 0.4, 0.2 m/s, with an initial spin.
Rebound spinning(Law law, double spin, int steps) {
  Sphere sphere = on_plane({70e9, .33}, .1, 2700);
  sphere.beta = damping_ratio_clipped(.5);
  sphere.friction = .4;
  sphere.law = law;
  return collide(sphere, {0, -.2, 0, spin}, elastic_time(sphere, .2) / steps);
}

TEST(SpinningImpact, SlidesAndSticksAsTabled) {
  for (Law law : {Law::hdd, Law::mindlin}) {
    const Rebound slides = spinning(law, -20, 200);
    EXPECT_NEAR(slides.motion.v_t, .12, 5e-3 * .12);  // mu (1 + e) v_n
    EXPECT_NEAR(slides.motion.spin, -20 + 3, 5e-3 * 3);
  }
  EXPECT_NEAR(spinning(Law::hdd, -.5, 200).motion.v_t, .01576, 5e-3 * .01576);
  EXPECT_NEAR(spinning(Law::hdd, -2, 200).motion.v_t, .07076, 5e-3 * .07076);
  EXPECT_NEAR(spinning(Law::mindlin, -.5, 200).motion.v_t, .01419, 5e-3 * .01419);
  EXPECT_NEAR(spinning(Law::mindlin, -2, 200).motion.v_t, .06422, 5e-3 * .06422);
}

TEST(SpinningImpact, TheCommonHistoryLosesImpulse) {
  const double v_t = spinning(Law::hdd_common, -20, 200).motion.v_t;
  EXPECT_GT(v_t, .07);  // 0.097 here, 0.089 to 0.102 by spin; 0.078 to 0.096 was found elsewhere; 0.12 is right
  EXPECT_LT(v_t, .10);
}

// The bouncing ball of MFiX: linear, tail kept.

struct Bounce {
  double begin, overlap, lasts, leaves;
};

/// From 0.5 m, dt in s, to the end of the first contact. The drop is exact up to a step before the floor.
Bounce bounce(double restitution, double dt) {
  constexpr double radius = .1, k = 1e4, g = 9.81, height = .5;
  const double mass = mass_of(radius, 2600), damping = linear_damping(damping_ratio_kept(restitution), k, mass);
  double t = std::sqrt(2 * (height - radius) / g) - 0.5 * dt, y = height - 0.5 * g * t * t, v = -g * t;
  double force = -mass * g;
  Bounce out{0, 0, 0, 0};
  while (true) {
    const double y_old = y;
    v += 0.5 * dt * force / mass;
    y += dt * v;
    t += dt;
    const double overlap = radius - y;
    force = (overlap > 0 ? k * overlap - damping * v : 0) - mass * g;
    v += 0.5 * dt * force / mass;
    if (overlap > 0 && y_old >= radius) out.begin = t - dt * overlap / (y_old - y);
    out.overlap = std::max(out.overlap, overlap);
    if (overlap <= 0 && y_old < radius) {
      out.lasts = t - dt * (y - radius) / (y - y_old) - out.begin;
      out.leaves = v;
      return out;
    }
  }
}

TEST(BouncingBall, IsThatOfMfix) {
  // 1e5 steps per contact: the scheme is of first order with damping. 1e-4 is asked for.
  const Bounce elastic = bounce(1, 1e-6), damped = bounce(.8, 1e-6);
  EXPECT_NEAR(elastic.begin, .2855686, 1e-4 * .2855686);
  EXPECT_NEAR(elastic.overlap, .1037500, 1e-4 * .10375);
  EXPECT_NEAR(elastic.lasts, .1112704, 1e-4 * .1112704);
  EXPECT_NEAR(damped.overlap, .0929871, 1e-4 * .0929871);
  EXPECT_NEAR(damped.lasts, .1126481, 1e-4 * .1126481);
  EXPECT_NEAR(damped.leaves, 2.149490, 1e-4 * 2.14949);
}

}  // namespace
}  // namespace polybed::closures::impact
