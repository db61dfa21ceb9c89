// Rolling friction through the engine against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench.hpp"
#include "closures/contact_hertz.hpp"
#include "closures/rolling_friction.hpp"

namespace polybed::dem::test {
namespace {

constexpr double overlap = 2e-5, rolling_friction = 0.1;
// Of the overlap, whose place is a hundred times larger, and of whole units of torque.
constexpr double round_off = 1e-12;

core::Scene rolling(const char* law, double damping = 0) {
  core::Scene scene = scene_of({{"rolling", law}});
  scene.dem.rolling_friction = rolling_friction;
  scene.dem.rolling_damping = damping;
  return scene;
}

struct Pressed {
  double force, limit, stiffness;
};

Pressed pressed(const Bench& bench) {
  const PairMaterial& k = bench.kind();
  const double force = closures::hertz_greatest_force(closures::hertz_coefficient(k.youngs_modulus, k.radius), overlap);
  return {force, rolling_friction * k.radius * force,
          closures::rolling_stiffness(force / overlap, rolling_friction, k.radius)};
}

/// Moment of rolling alone: the surface is kept at rest, so that friction adds nothing.
Vector moment(Bench& bench, const Vector& spin) {
  const double arm = bench.radius() - overlap;
  bench.press(overlap, {-arm * spin[2], 0, arm * spin[0]}, spin);
  return bench.torque_now();
}

TEST(Rolling, ConstantMomentAgainstTheRollingPart) {
  Bench bench(rolling("cdt"), 1e-6);
  bench.add(overlap, {});
  const double limit = pressed(bench).limit;
  const Vector m = moment(bench, {3, 7, -4});  // 7 is twisting
  EXPECT_NEAR(m[0], -0.6 * limit, round_off * limit);
  EXPECT_NEAR(m[1], 0, round_off * limit);
  EXPECT_NEAR(m[2], 0.8 * limit, round_off * limit);
  EXPECT_NEAR(moment(bench, {0, 7, 0})[2], 0, round_off * limit);
}

TEST(Rolling, SpringFollowsTheScalarLawToItsCapAndBack) {
  for (double damping : {0.0, 0.3}) {
    Bench bench(rolling("epsd", damping), 1e-6);
    bench.add(overlap, {});
    const Pressed p = pressed(bench);
    const Species& s = bench.materials.species()[0];
    const double inertia = s.inertia + s.mass * s.radius * s.radius;
    const double dashpot = closures::rolling_damping(damping, inertia, p.stiffness);
    const double spin = 0.04 * p.limit / p.stiffness / bench.dt;  // to the cap in 25 steps
    closures::Vec3 spring{0, 0, 0};
    for (int n = 0; n < 100; ++n) {
      const double w = n < 40 ? spin : -spin;
      const closures::RollingMoment expected =
          closures::rolling_epsd(spring, {0.6 * w, 0, 0.8 * w}, p.stiffness, dashpot, p.limit, bench.dt);
      spring = expected.spring;
      const Vector m = moment(bench, {0.6 * w, 5, 0.8 * w});
      const double scale = p.limit + dashpot * spin;
      EXPECT_NEAR(m[0], expected.moment.x, 100 * round_off * scale) << n;  // a hundred steps add their round-off
      EXPECT_NEAR(m[2], expected.moment.z, 100 * round_off * scale) << n;
    }
    EXPECT_NEAR(std::hypot(spring.x, spring.z), p.limit, round_off * p.limit);  // at the cap the other way
  }
}

/// A sphere on a floor whose gravity leans by `slope`, at rest on its spring; after some steps.
Motion roll(const core::Scene& scene, double slope, double speed, double seconds) {
  const double g = 9.81;
  const Bench bare(scene, 1);
  const PairMaterial& k = bare.kind();
  const double coefficient = closures::hertz_coefficient(k.youngs_modulus, k.radius);
  const double rest = std::pow(k.mass * g * std::cos(slope) / coefficient, 2.0 / 3);
  const double dt = 2e-5;
  Bench bench(scene, dt, {g * std::sin(slope), -g * std::cos(slope), 0});
  bench.add(rest, {speed, 0, 0}, {0, 0, -speed / (bare.radius() - rest)});
  bench.press(rest, {speed, 0, 0}, {0, 0, -speed / (bare.radius() - rest)});  // the loads of the first half kick
  for (int n = 0; n < int(seconds / dt); ++n) bench.step();
  return bench.particles.motion[0];
}

TEST(Rolling, DeceleratesAsTheClosedFormSays) {
  // a = -(5/7) mu_r g; the lever arm is shorter than R by the overlap, 2e-3 of it.
  core::Scene scene = rolling("cdt");
  const double a = 5.0 / 7 * rolling_friction * 9.81;
  EXPECT_NEAR(roll(scene, 0, 0.2, 0.1).v[0], 0.2 - 0.1 * a, 3e-3 * 0.1 * a);
}

TEST(Rolling, SpringHoldsASphereOnASlopeAndLetsItRollOnASteeperOne) {
  const core::Scene scene = rolling("epsd", 0.3);
  EXPECT_LT(std::abs(roll(scene, std::atan(0.08), 0, 0.5).v[0]), 1e-5);  // tan < mu_r: at rest
  // tan > mu_r: (5/7) g (sin - mu_r cos), but for the time in which the spring is wound and the arm.
  const double slope = std::atan(0.2), a = 5.0 / 7 * 9.81 * (std::sin(slope) - rolling_friction * std::cos(slope));
  const double before = roll(scene, slope, 0, 0.3).v[0], after = roll(scene, slope, 0, 0.5).v[0];
  EXPECT_NEAR((after - before) / 0.2, a, 3e-3 * a);
}

}  // namespace
}  // namespace polybed::dem::test
