// Oblique impacts on a floor through the engine against the scalar reference of the closures' tests.
#include <gtest/gtest.h>

#include <cmath>

#include "../closures/contact_impact.hpp"
#include "bench.hpp"
#include "closures/restitution.hpp"

namespace polybed::dem::test {
namespace {

using closures::impact::Law;

struct Named {
  const char* contact;
  const char* tangential;
  Law law;
};
constexpr Named laws[] = {{"hertz", "hdd", Law::none},
                          {"hertz_mindlin", "hdd", Law::hdd},
                          {"hertz_mindlin", "mindlin", Law::mindlin},
                          {"hertz_mindlin", "mindlin_deresiewicz", Law::mindlin_deresiewicz}};

core::Scene scene_of(const Named& named, double restitution) {
  core::Scene scene = test::scene_of({{"contact", named.contact}});
  scene.dem.tangential = core::choice_of<core::Tangential>(named.tangential);
  core::set_restitution(scene, restitution);
  core::set_friction(scene, 0.3);
  return scene;
}

closures::impact::Sphere reference_of(const Bench& bench, Law law) {
  const PairMaterial& k = bench.kind();
  closures::impact::Sphere sphere{k.mass, k.radius, k.youngs_modulus, k.shear_modulus};
  sphere.beta = closures::damping_ratio_clipped(k.restitution);
  sphere.friction = k.friction;
  sphere.law = law;
  return sphere;
}

/// Velocity and spin of a sphere after an impact, along the direction (cos, sin) in the plane of the floor.
closures::impact::Motion collide(Bench& bench, const closures::impact::Motion& start, double cos, double sin) {
  bench.add(start.overlap, {start.v_t * cos, start.v_n, start.v_t * sin});
  do bench.step();
  while (bench.particles.motion[0].v[1] <= 0 || bench.overlap(0) > 0);
  const Motion& m = bench.particles.motion[0];
  // The velocity of the contact is v + l w_z along x and v - l w_x along z.
  return {bench.overlap(0), m.v[1], m.v[0] * cos + m.v[2] * sin, m.w[2] * cos - m.w[0] * sin};
}

double step_of(const core::Scene& scene, int steps) {
  const Bench bench(scene, 1);
  return closures::impact::elastic_time(reference_of(bench, Law::none), 1) / steps;
}

TEST(Impact, IsThatOfTheScalarReference) {
  for (const Named& named : laws)
    for (double restitution : {1.0, 0.7})
      for (double v_t : {0.05, 0.3, 1.0, 4.0})
        for (double phase : {0.0, 0.37, 0.9}) {
          const core::Scene scene = scene_of(named, restitution);
          Bench bench(scene, step_of(scene, 100));
          const closures::impact::Motion start{-phase * bench.dt, -1, v_t};
          const closures::impact::Motion expected =
              closures::impact::collide(reference_of(bench, named.law), start, bench.dt).motion;
          const closures::impact::Motion out = collide(bench, start, 1, 0);
          // Round-off of 200 steps of an overlap that is 1/30 of the place it is the difference of.
          EXPECT_NEAR(out.v_n, expected.v_n, 1e-12) << named.tangential << v_t;
          EXPECT_NEAR(out.v_t, expected.v_t, 1e-12) << named.tangential << v_t;
          EXPECT_NEAR(out.spin, expected.spin, 1e-12 / bench.radius()) << named.tangential << v_t;
        }
}

TEST(Impact, HasNoPreferredDirection) {
  for (const Named& named : laws)
    for (double angle : {0.4, 2.0, 4.5}) {
      const core::Scene scene = scene_of(named, 0.7);
      Bench along(scene, step_of(scene, 100)), turned(scene, along.dt);
      const closures::impact::Motion start{0, -1, 0.3};
      const closures::impact::Motion expected = collide(along, start, 1, 0);
      const closures::impact::Motion out = collide(turned, start, std::cos(angle), std::sin(angle));
      EXPECT_NEAR(out.v_t, expected.v_t, 1e-12) << named.tangential;  // round-off, as above
      EXPECT_NEAR(out.spin, expected.spin, 1e-12 / along.radius()) << named.tangential;
    }
}

/// Greatest error of v_t after an impact at 5 degrees over the phase of the first step, over the speed.
double error_over_phases(const Named& named, int steps, bool synchronised) {
  const core::Scene scene = scene_of(named, 1);
  const double v_t = std::tan(5 * 3.14159265358979 / 180);
  const double fine_step = step_of(scene, 20000);
  Bench fine(scene, fine_step);
  const double expected = collide(fine, {0, -1, v_t}, 1, 0).v_t;
  double largest = 0;
  for (int phase = 0; phase < 20; ++phase) {
    Bench bench(scene, step_of(scene, steps), {}, synchronised);
    largest = std::max(largest, std::abs(collide(bench, {-bench.dt * phase / 20, -1, v_t}, 1, 0).v_t - expected));
  }
  return largest;
}

TEST(Impact, DoesNotDependOnThePhaseOfTheFirstStep) {
  for (std::size_t n = 1; n < 4; ++n)
    for (bool synchronised : {false, true}) {
      const double error = error_over_phases(laws[n], 200, synchronised);
      RecordProperty(std::string(laws[n].tangential) + (synchronised ? "_synchronised" : ""), std::to_string(error));
      EXPECT_LT(error, 5e-3) << laws[n].tangential << synchronised;  // goal; found 1.4e-3
    }
}

}  // namespace
}  // namespace polybed::dem::test
