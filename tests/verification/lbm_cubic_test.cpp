// Stokes flow through cubic arrays of spheres: Zick and Homsy, J. Fluid Mech. 115 (1982) 13, table 2 (simple cubic);
// Hasimoto, J. Fluid Mech. 5 (1959) 317 (dilute); their values for touching spheres.
#include <gmock/gmock.h>

#include <cmath>

#include "unit/lbm/cubic_arrays.hpp"

using namespace polybed::lbm;

namespace {

double net(Cubic kind, double solids, int cells) {
  return flow_through(cubic_array(kind, solids, cells), {{cells, cells, cells}, 1.0 / 6, false, Wall::interpolated},
                      {1e-3, 0, 0}, 1e-5)
      .net;
}

/// From two grids, second order.
double extrapolated(Cubic kind, double solids, int coarse, int fine) {
  const double a = net(kind, solids, coarse), b = net(kind, solids, fine);
  return b + (b - a) / (std::pow(double(fine) / coarse, 2) - 1);
}

/// K of a dilute array; c: 1.7601, 1.7918, 1.7917; c2: 1.5593, 0.329, 0.302.
double hasimoto(double first, double last, double c) { return 1 / (1 - first * std::cbrt(c) + c - last * c * c); }

}  // namespace

TEST(CubicArrays, SimpleCubicAgreesWithTheTable) {
  EXPECT_NEAR(extrapolated(Cubic::simple, 0.027, 20, 30), 2.008, 0.01 * 2.008);
  EXPECT_NEAR(extrapolated(Cubic::simple, 0.125, 24, 36), 4.292, 0.01 * 4.292);
  EXPECT_NEAR(extrapolated(Cubic::simple, 0.216, 16, 24), 7.442, 0.01 * 7.442);
  EXPECT_NEAR(extrapolated(Cubic::simple, 0.343, 20, 30), 15.4, 0.01 * 15.4);
  EXPECT_NEAR(extrapolated(Cubic::simple, 0.45, 20, 30), 28.1, 0.01 * 28.1);
  EXPECT_NEAR(extrapolated(Cubic::simple, 0.5236, 24, 36), 42.1, 0.01 * 42.1);
}

TEST(CubicArrays, ErrorIsOfSecondOrder) {
  const double coarse = 7.442 - net(Cubic::simple, 0.216, 16), fine = 7.442 - net(Cubic::simple, 0.216, 32);
  EXPECT_LT(std::abs(fine), 0.01 * 7.442);
  EXPECT_THAT(coarse / fine, testing::AllOf(testing::Gt(3.0), testing::Lt(5.0)));
}

TEST(CubicArrays, DiluteCentredArraysAgreeWithTheSeries) {
  const double body = hasimoto(1.7918, 0.329, 0.027), face = hasimoto(1.7917, 0.302, 0.027);
  EXPECT_NEAR(extrapolated(Cubic::body_centred, 0.027, 24, 36), body, 0.01 * body);
  EXPECT_NEAR(extrapolated(Cubic::face_centred, 0.027, 28, 40), face, 0.01 * face);
}

TEST(CubicArrays, TouchingBodyCentredArrayAgreesWithTheTable) {
  EXPECT_NEAR(extrapolated(Cubic::body_centred, 0.6802, 36, 48), 162.9, 0.01 * 162.9);
}

TEST(CubicArrays, TouchingFaceCentredArrayAgreesWithTheTable) {
  EXPECT_NEAR(extrapolated(Cubic::face_centred, 0.7405, 32, 48), 435, 0.01 * 435);
}
