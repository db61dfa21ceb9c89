// The liquid bridge of Willett et al., by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "closures/liquid_bridge_willett.hpp"

namespace polybed::closures {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(LiquidBridge, PullByHand) {
  EXPECT_NEAR(liquid_bridge_pull(1e-3, 0.072, 0), 4.523893421169302e-4, 1e-18);                     // 1.44e-4 pi
  EXPECT_NEAR(liquid_bridge_pull(1e-3, 0.072, std::numbers::pi / 3), 2.261946710584651e-4, 1e-18);  // half of it
  EXPECT_NEAR(liquid_bridge_pull(1e-3, 0.072, std::numbers::pi / 2), 0, 1e-19);
}

TEST(LiquidBridge, ForceByHand) {
  // R 1 mm, V 1e-12 m3: sqrt(R/V) = 31622.776 1/m; at 10 um s* = 0.31622777 and 1 + 0.33203915 + 0.25 = 1.58203915.
  const double stretch = std::sqrt(1e-3 / 1e-12);
  EXPECT_NEAR(liquid_bridge_force(1, stretch, 1e-5), -1 / 1.5820391543, 1e-10);
  EXPECT_EQ(liquid_bridge_force(4e-4, stretch, 0), -4e-4);
  EXPECT_EQ(liquid_bridge_force(4e-4, stretch, -1e-5), -4e-4);
  EXPECT_NEAR(liquid_bridge_rupture(1e-12, 0), 1e-4, 1e-18);
  EXPECT_NEAR(liquid_bridge_rupture(1e-12, 0.5), 1.25e-4, 1e-18);
}

// Bridges between equal spheres by the equation of Young and Laplace, integrated apart from this program: the first
// integral r sin(psi) - p r^2/2 = F/(2 pi), the neck half-way, Gauss quadrature, and roots for the neck and the filling
// angle of a given V. What the closed form misses is stated in docs/theory/particle-contact.md.
TEST(LiquidBridge, IsNearTheExactForce) {
  struct Exact {
    double degrees, volume, share_of_rupture, force, off;  // V/R^3, s/s_c, F/(2 pi R gamma), of the closed form
  };
  for (const Exact& e : {Exact{0, 1e-4, 1e-4, 0.96393, 0.037}, Exact{0, 1e-3, 0.1, 0.61772, 0.023},
                         Exact{0, 1e-3, 0.3, 0.25350, -0.071}, Exact{0, 1e-3, 0.9, 0.04864, -0.152},
                         Exact{0, 1e-2, 1e-4, 0.88421, 0.131}, Exact{0, 1e-2, 0.6, 0.18393, -0.168},
                         Exact{0, 0.056, 1e-4, 0.81806, 0.222}, Exact{0, 0.056, 0.3, 0.48418, -0.015},
                         Exact{20, 1e-3, 0.1, 0.53483, 0.013}, Exact{20, 1e-2, 0.6, 0.14678, -0.234},
                         Exact{40, 1e-3, 0.3, 0.14198, -0.162}, Exact{40, 1e-2, 1e-4, 0.63570, 0.205}}) {
    const double angle = e.degrees * std::numbers::pi / 180, rupture = liquid_bridge_rupture(e.volume, angle);
    const double pull = liquid_bridge_pull(1, 1 / (2 * std::numbers::pi), angle);
    const double force = -liquid_bridge_force(pull, std::sqrt(1 / e.volume), e.share_of_rupture * rupture);
    EXPECT_NEAR(force / e.force - 1, e.off, 1e-3) << e.degrees << " " << e.volume << " " << e.share_of_rupture;
  }
}

TEST(LiquidBridge, CapsOfNeighboursAreDisjoint) {
  EXPECT_NEAR(covered_share(1, 1), 0.06698729810778066, 1e-16);  // (1 - sqrt(3/4))/2
  EXPECT_EQ(covered_share(1e-3, infinity), 0.5);
  EXPECT_LE(12 * covered_share(1, 1), 1);   // the most that touch one of their size
  EXPECT_LE(2 * covered_share(1, 1e6), 1);  // between two far larger ones
  double before = 0;
  for (double partner = 0.01; partner < 100; partner *= 1.3) {
    EXPECT_GT(covered_share(1, partner), before);
    before = covered_share(1, partner);
  }
}

TEST(LiquidBridge, EnergyIsTheIntegralOfTheForce) {
  const double pull = 4e-4, stretch = 3e4, rupture = 1.2e-4;
  EXPECT_EQ(liquid_bridge_energy(pull, stretch, rupture, rupture), 0);
  for (const double gap : {1.1e-4, 5e-5, 1e-5, 1e-7, -1e-7, -3e-5}) {
    const double step = 1e-9;
    const double slope = (liquid_bridge_energy(pull, stretch, rupture, gap + step) -
                          liquid_bridge_energy(pull, stretch, rupture, gap - step)) /
                         (2 * step);
    // F = -dU/d(gap); of second order in the step, (step stretch)^2 = 1e-9.
    EXPECT_NEAR(-slope, liquid_bridge_force(pull, stretch, gap), 1e-8 * pull) << gap;
  }
}

}  // namespace
}  // namespace polybed::closures
