// Side force and torque on a spinning sphere: value, sign, limits.
#include <gtest/gtest.h>

#include <cmath>

#include "closures/magnus_rubinow_keller.hpp"

namespace polybed::closures {
namespace {

constexpr double bead = 1e-3, density = 1000, viscosity = 1e-3;

TEST(Magnus, ByHand) {
  // (pi/8) 1000 1e-9 10 0.0005 at Re_p 0.5, and 0.45 of it per slip at Re_p 20.
  EXPECT_NEAR(magnus_rubinow_keller({-0.0005, 0, 0}, {0, 0, 10}, bead, density, viscosity).y, 1.9634954084936207e-09,
              1e-23);
  EXPECT_NEAR(magnus_rubinow_keller({-0.02, 0, 0}, {0, 0, 10}, bead, density, viscosity).y, 3.534291735288517e-08,
              1e-22);
  EXPECT_NEAR(spin_resistance(viscosity, bead), 3.1415926535897936e-12, 1e-26);  // pi 1e-3 1e-9
}

TEST(Magnus, LiftsABallWithBackspin) {
  // It flies along +x through fluid at rest, y up. Backspin: the velocity of its top, Omega x (r y), is along -x.
  const Vec3 velocity{0.3, 0, 0}, spin{0, 0, 50}, top = cross(spin, {0, bead / 2, 0});
  ASSERT_LT(top.x, 0);
  const Vec3 slip = Vec3{0, 0, 0} - velocity;
  EXPECT_GT(magnus_rubinow_keller(slip, spin_relative_to_fluid(spin, {0, 0, 0}), bead, density, viscosity).y, 0);
  // Topspin pulls it down; a drill, spinning about its path, feels nothing.
  EXPECT_LT(magnus_rubinow_keller(slip, {0, 0, -50}, bead, density, viscosity).y, 0);
  const Vec3 drill = magnus_rubinow_keller(slip, {50, 0, 0}, bead, density, viscosity);
  EXPECT_EQ(dot(drill, drill), 0);
}

TEST(Magnus, NothingOnASphereThatTurnsWithTheFluid) {
  const Vec3 vorticity{1, -2, 4}, relative = spin_relative_to_fluid({0.5, -1, 2}, vorticity);
  EXPECT_EQ(dot(relative, relative), 0);
  EXPECT_EQ(magnus_rubinow_keller({0.1, 0, 0}, relative, bead, density, viscosity).y, 0);
}

TEST(Magnus, ForceDoesNoWork) {
  const Vec3 slip{0.01, -0.02, 0.005}, relative{1, 2, -4},
      force = magnus_rubinow_keller(slip, relative, bead, density, viscosity);
  EXPECT_NEAR(dot(force, slip), 0, 1e-16 * std::sqrt(dot(force, force)));  // round-off of three products of 1e-2
}

TEST(Magnus, LinearOnEitherSideOfReynoldsOne) {
  const Vec3 spin{0, 0, 10};
  const double below = magnus_rubinow_keller({-0.001, 0, 0}, spin, bead, density, viscosity).y,
               above = magnus_rubinow_keller({-0.001000001, 0, 0}, spin, bead, density, viscosity).y;
  EXPECT_NEAR(above / below, 0.45, 1e-6);
  EXPECT_NEAR(magnus_rubinow_keller({-0.0005, 0, 0}, spin, bead, density, viscosity).y, below / 2, 1e-23);
  EXPECT_NEAR(magnus_rubinow_keller({-0.001, 0, 0}, 2.0 * spin, bead, density, viscosity).y, 2 * below, 1e-23);
}

}  // namespace
}  // namespace polybed::closures
