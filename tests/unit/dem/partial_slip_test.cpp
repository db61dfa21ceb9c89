// The law with partial slip in three dimensions: along a line the scalar rule; across it the whole stiffness.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench.hpp"
#include "closures/contact_hertz.hpp"
#include "closures/contact_tangential.hpp"

namespace polybed::dem::test {
namespace {

constexpr double overlap = 2e-5;

core::Scene partial_slip() {
  core::Scene scene = scene_of({});
  scene.dem.tangential = core::Tangential::mindlin_deresiewicz;
  core::set_friction(scene, 0.3);
  return scene;
}

class PartialSlip : public testing::Test {
 protected:
  PartialSlip() {
    bench.add(overlap, {});
    bench.press(overlap, {});
    const PairMaterial& k = bench.kind();
    const double a = closures::contact_radius(k.radius, overlap);
    limit = 0.3 * closures::hertz_greatest_force(closures::hertz_coefficient(k.youngs_modulus, k.radius), overlap);
    stiffness = closures::tangential_stiffness(k.shear_modulus, a);
    xi_m = 1.5 * limit / stiffness;
  }

  /// Moves the contact by (x, z) in steps; the force against the displacement.
  Vector move(double x, double z, int steps) {
    Vector force{};
    for (int n = 0; n < steps; ++n) force = bench.press(overlap, {x / steps / bench.dt, 0, z / steps / bench.dt});
    return {-force[0], force[1], -force[2]};
  }
  [[nodiscard]] double loading(double xi) const { return limit * (1 - std::pow(1 - xi / xi_m, 1.5)); }

  Bench bench{partial_slip(), 1e-6};
  double limit, stiffness, xi_m;
};

TEST_F(PartialSlip, AlongAnyLineIsTheClosedForm) {
  // Up to 0.8 xi_m and back to 0, at 0.9 rad to x; the explicit rule errs by 0.2/N of mu F_n.
  const double c = std::cos(0.9), s = std::sin(0.9), peak = 0.8 * xi_m;
  Vector f = move(c * peak, s * peak, 4000);
  EXPECT_NEAR(f[0], c * loading(peak), 1e-4 * limit);
  EXPECT_NEAR(f[2], s * loading(peak), 1e-4 * limit);
  f = move(-c * peak, -s * peak, 4000);
  const double back = loading(peak) - 2 * limit * (1 - std::pow(1 - peak / (2 * xi_m), 1.5));
  EXPECT_LT(back, 0);
  EXPECT_NEAR(f[0], c * back, 1e-4 * limit);
  EXPECT_NEAR(f[2], s * back, 1e-4 * limit);
}

TEST_F(PartialSlip, AcrossItsForceMeetsTheWholeStiffness) {
  const double before = move(0.5 * xi_m, 0, 1000)[0], aside = 1e-6 * xi_m;
  const Vector f = move(0, aside, 1);
  EXPECT_NEAR(f[2], stiffness * aside, 1e-5 * stiffness * aside);  // to second order of the turn
  EXPECT_NEAR(f[0], before, 1e-9 * limit);
}

TEST_F(PartialSlip, TurnsIntoTheDirectionInWhichItSlides) {
  (void)move(3 * xi_m, 0, 1000);
  const Vector f = move(0, 20 * xi_m, 4000);
  EXPECT_NEAR(f[2], limit, 1e-6 * limit);  // what is left across falls as exp(-20 xi_m S_t/mu F_n) = exp(-30)
  EXPECT_NEAR(f[0], 0, 1e-6 * limit);
}

TEST_F(PartialSlip, NeverExceedsFrictionAndMakesNoEnergyAroundACircle) {
  constexpr int steps = 4000;
  for (double share : {0.6, 1.0}) {
    const double radius = share * xi_m, path = 2 * std::numbers::pi * radius;
    const auto stored = [&](const Vector& f) { return 0.5 * (f[0] * f[0] + f[2] * f[2]) / stiffness; };
    double lost = 0;
    Vector last{};
    for (int n = 0; n < 3 * steps; ++n) {
      const double from = 2 * std::numbers::pi * n / steps, to = 2 * std::numbers::pi * (n + 1) / steps;
      const double x = radius * (std::cos(to) - std::cos(from)), z = radius * (std::sin(to) - std::sin(from));
      const Vector f = move(x, z, 1);
      EXPECT_LE(std::hypot(f[0], f[2]), limit * (1 + 1e-12));
      if (n >= 2 * steps) lost += 0.5 * ((last[0] + f[0]) * x + (last[2] + f[2]) * z) - (stored(f) - stored(last));
      last = f;
    }
    // The small circle ends elastic, so that the error of the explicit rule is left, 0.2/N of mu F_n along the path.
    EXPECT_GT(lost, share < 1 ? -0.2 / steps * limit * path : 0.5 * limit * path);
    EXPECT_LT(lost, limit * path);  // what gross sliding loses
  }
}

}  // namespace
}  // namespace polybed::dem::test
