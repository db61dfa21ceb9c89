#include "fluid/inlet.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace polybed::fluid {
namespace {

TEST(Ramp, IsLinearBetweenItsPointsAndMayJump) {
  const Ramp ramp({{1.0, 0.1}, {2.0, 0.3}, {2.0, 0.5}, {4.0, 0.5}});
  EXPECT_EQ(ramp.velocity(0), 0.1);
  EXPECT_DOUBLE_EQ(ramp.velocity(1.5), 0.2);
  EXPECT_EQ(ramp.velocity(std::nextafter(2.0, 3.0)), 0.5);
  EXPECT_EQ(ramp.velocity(9), 0.5);
  EXPECT_DOUBLE_EQ(ramp.rate(1.5), 0.2);
  EXPECT_EQ(ramp.rate(3), 0);
  EXPECT_EQ(ramp.greatest(), 0.5);
}

// 0.1 before 1 s, then the mean of 0.1 and 0.3 to 2 s, then 0.5: to 1.5 s 0.1 + 0.5 (0.1 + 0.2)/2, to 6 s 0.1 + 0.2 + 4
// 0.5.
TEST(Ramp, IsIntegratedFromTimeZero) {
  const Ramp ramp({{1.0, 0.1}, {2.0, 0.3}, {2.0, 0.5}, {4.0, 0.5}});
  EXPECT_EQ(ramp.integral(-1), 0);
  EXPECT_DOUBLE_EQ(ramp.integral(0.5), 0.05);
  EXPECT_DOUBLE_EQ(ramp.integral(1.5), 0.175);
  EXPECT_DOUBLE_EQ(ramp.integral(6), 2.3);
  EXPECT_DOUBLE_EQ(Ramp({{0.0, 0.4}}).integral(2), 0.8);
  EXPECT_DOUBLE_EQ(Ramp({{-1.0, 0.0}, {1.0, 2.0}}).integral(2), 1.5 + 2);
  EXPECT_EQ(Ramp().integral(2), 0);
}

core::Scene with_jet(int dimensions) {
  core::Scene scene;
  scene.inlet.superficial_velocity = {{0.0, 0.01}};
  scene.jets.push_back({{0.013}, {0.026}, {{0.0, 0.2}, {1.0, 0.4}}});
  if (dimensions == 3) {
    scene.jets[0].from.push_back(0.0);
    scene.jets[0].to.push_back(0.01);
  }
  return scene;
}

core::Grid bottom(int nx, int nz) {
  core::Grid grid;
  grid.dimensions = nz > 1 ? 3 : 2;
  grid.cells = {nx, 3, nz};
  grid.spacing = {0.04 / nx, 0.01, 0.02 / nz};
  return grid;
}

// 13 mm of 40 at 0.2 m/s, the rest at 0.01: (0.013 0.2 + 0.027 0.01)/0.04 = 0.07175 m/s, on any grid.
TEST(Inlet, AJetTakesItsAreaOnAnyGrid) {
  for (const int nx : {1, 4, 7, 40}) {
    const core::Grid grid = bottom(nx, 1);
    const Inlet inlet(grid, with_jet(2));
    core::Field flux = core::make_field(grid);
    inlet.set_velocity(0, flux);
    double sum = 0;
    for (int i = 0; i < nx; ++i) sum += flux[std::size_t(grid.index(i, 0))] / nx;
    EXPECT_NEAR(sum, 0.07175, 1e-15) << nx;
    EXPECT_NEAR(inlet.mean_velocity(0), 0.07175, 1e-15);
  }
}

TEST(Inlet, FacesHaveTheirShare) {
  const core::Grid grid = bottom(4, 1);  // faces of 10 mm; the jet covers 7 mm of the second and 6 mm of the third
  const Inlet inlet(grid, with_jet(2));
  core::Field flux = core::make_field(grid), rate = flux;
  inlet.set_velocity(0.5, flux);
  inlet.set_rate(0.5, rate);
  EXPECT_DOUBLE_EQ(flux[std::size_t(grid.index(0, 0))], 0.01);
  EXPECT_DOUBLE_EQ(flux[std::size_t(grid.index(1, 0))], 0.7 * 0.3 + 0.3 * 0.01);
  EXPECT_DOUBLE_EQ(flux[std::size_t(grid.index(2, 0))], 0.6 * 0.3 + 0.4 * 0.01);
  EXPECT_NEAR(rate[std::size_t(grid.index(1, 0))], 0.7 * 0.2, 1e-15);
  EXPECT_EQ(rate[std::size_t(grid.index(3, 0))], 0);
  EXPECT_EQ(inlet.breakpoints(), (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(inlet.greatest(), 0.4);
}

TEST(Inlet, KnowsWhetherItShuts) {
  core::Scene scene = with_jet(2);
  const auto shuts = [&] { return Inlet(bottom(4, 1), scene).shuts(); };
  EXPECT_FALSE(shuts());
  scene.jets.clear();
  scene.inlet.superficial_velocity = {{0.0, 0.01}, {1.0, 0.0}, {1.0, 0.02}};
  EXPECT_FALSE(shuts()) << "0 at no time: it falls to it and jumps";
  scene.inlet.superficial_velocity = {{0.0, 0.01}, {1.0, 0.01}, {1.0, 0.0}};
  EXPECT_TRUE(shuts());
  scene.inlet.superficial_velocity = {{0.0, 0.0}, {1.0, 0.02}};
  EXPECT_TRUE(shuts()) << "at its start";
}

// Half of the depth: (0.013 0.01 0.2 + (0.04 0.02 - 0.013 0.01) 0.01)/(0.04 0.02) = 0.040875 m/s.
TEST(Inlet, AJetInThreeDimensionsIsARectangle) {
  const Inlet inlet(bottom(5, 3), with_jet(3));
  EXPECT_NEAR(inlet.mean_velocity(0), 0.040875, 1e-15);
}

}  // namespace
}  // namespace polybed::fluid
