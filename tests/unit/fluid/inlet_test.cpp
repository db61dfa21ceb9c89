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
    core::FaceField flux = core::make_face_field(grid);
    inlet.set_velocity(0, flux);
    double sum = 0;
    for (int i = 0; i < nx; ++i) sum += flux[1][std::size_t(grid.index(i, 0))] / nx;
    EXPECT_NEAR(sum, 0.07175, 1e-15) << nx;
    EXPECT_NEAR(inlet.mean_velocity(0), 0.07175, 1e-15);
  }
}

// Voidage 0.6. Of a feed the fluid has nothing, of a discharge 0.6 of the flux, of the rest all.
TEST(Inlet, KnowsWhatTheFluidHasOfAFlux) {
  core::Scene scene;
  scene.inlet.superficial_velocity = {{0.0, 0.01}};
  scene.feeds.push_back({"a", core::ColumnFace::bottom, {{0.0, 0.002}}, 0.1, {0.0}, {0.01}});
  scene.feeds.push_back({"a", core::ColumnFace::right, {{0.0, 0.003}}, 0.1, {0.0}, {0.01}});
  scene.discharges.push_back({core::ColumnFace::bottom, {0.02}, {0.03}, {{0.0, 0.05}}});
  scene.discharges.push_back({core::ColumnFace::left, {0.01}, {0.02}, {{0.0, 0.05}}});
  const core::Grid grid = bottom(4, 1);
  const Inlet inlet(grid, scene);
  core::FaceField flux = core::make_face_field(grid);
  inlet.set_velocity(0, flux);
  core::FaceField fluid = flux;
  core::Field voidage = core::make_field(grid);
  std::fill(voidage.begin(), voidage.end(), 0.6);
  inlet.take_solids_out(0, voidage, fluid);
  const auto at = [&](const core::FaceField& faces, std::size_t axis, int i, int j) {
    return faces[axis][std::size_t(grid.index(i, j))];
  };
  EXPECT_DOUBLE_EQ(at(flux, 1, 0, 0), 0.012);
  EXPECT_DOUBLE_EQ(at(fluid, 1, 0, 0), 0.01);
  EXPECT_DOUBLE_EQ(at(fluid, 1, 1, 0), 0.01);
  EXPECT_DOUBLE_EQ(at(flux, 1, 2, 0), -0.05);
  EXPECT_DOUBLE_EQ(at(fluid, 1, 2, 0), -0.03);
  EXPECT_DOUBLE_EQ(at(flux, 0, 4, 0), -0.003);
  EXPECT_EQ(at(fluid, 0, 4, 0), 0);
  EXPECT_DOUBLE_EQ(at(fluid, 0, 0, 1), -0.03);
}

TEST(Inlet, FacesHaveTheirShare) {
  const core::Grid grid = bottom(4, 1);  // faces of 10 mm; the jet covers 7 mm of the second and 6 mm of the third
  const Inlet inlet(grid, with_jet(2));
  core::FaceField flux = core::make_face_field(grid), rate = flux;
  inlet.set_velocity(0.5, flux);
  inlet.set_rate(0.5, rate);
  EXPECT_DOUBLE_EQ(flux[1][std::size_t(grid.index(0, 0))], 0.01);
  EXPECT_DOUBLE_EQ(flux[1][std::size_t(grid.index(1, 0))], 0.7 * 0.3 + 0.3 * 0.01);
  EXPECT_DOUBLE_EQ(flux[1][std::size_t(grid.index(2, 0))], 0.6 * 0.3 + 0.4 * 0.01);
  EXPECT_NEAR(rate[1][std::size_t(grid.index(1, 0))], 0.7 * 0.2, 1e-15);
  EXPECT_EQ(rate[1][std::size_t(grid.index(3, 0))], 0);
  EXPECT_EQ(inlet.breakpoints(), (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(inlet.greatest(), 0.4);
}

// Three faces of 10 mm in the right side, the jet from 5 to 25 mm: inwards is to the left. It shuts where all do.
TEST(Inlet, AJetInASideTakesItsFaces) {
  core::Scene scene;
  scene.inlet.superficial_velocity = {{0.0, 0.0}};
  scene.jets.push_back({{0.005}, {0.025}, {{0.0, 0.2}, {1.0, 0.4}}, core::ColumnFace::right});
  scene.discharges.push_back({core::ColumnFace::left, {}, {}, {{0.0, 0.1}}});
  const core::Grid grid = bottom(4, 1);
  const Inlet inlet(grid, scene);
  core::FaceField flux = core::make_face_field(grid, 7.0), rate = flux;
  inlet.set_velocity(0.5, flux);
  inlet.set_rate(0.5, rate);
  const auto at = [&](int i, int j) { return std::size_t(grid.index(i, j)); };
  EXPECT_DOUBLE_EQ(flux[0][at(4, 0)], -0.5 * 0.3);
  EXPECT_DOUBLE_EQ(flux[0][at(4, 1)], -0.3);
  EXPECT_DOUBLE_EQ(rate[0][at(4, 2)], -0.5 * 0.2);
  EXPECT_EQ(flux[0][at(0, 1)], -0.1);
  EXPECT_EQ(flux[0][at(3, 1)], 7) << "inside";
  EXPECT_EQ(flux[1][at(3, 0)], 0);
  EXPECT_EQ(inlet.mean_velocity(0.5), 0) << "through the bottom";
  EXPECT_EQ(inlet.greatest(), 0.4);
  EXPECT_FALSE(inlet.shuts());
  inlet.extend(flux);
  EXPECT_EQ(flux[0][at(5, 1)], flux[0][at(4, 1)]);
  EXPECT_EQ(flux[0][at(-2, 1)], flux[0][at(0, 1)]);
}

// The faces of 10 mm from 5 to 20 mm of the bottom: half of the first is the distributor's.
TEST(Inlet, ADischargeInTheBottomReplacesIt) {
  core::Scene scene;
  scene.inlet.superficial_velocity = {{0.0, 0.01}};
  scene.discharges.push_back({core::ColumnFace::bottom, {0.005}, {0.02}, {{0.0, 0.1}}});
  const core::Grid grid = bottom(4, 1);
  core::FaceField flux = core::make_face_field(grid);
  const Inlet inlet(grid, scene);
  inlet.set_velocity(0, flux);
  EXPECT_DOUBLE_EQ(flux[1][std::size_t(grid.index(0, 0))], 0.5 * 0.01 - 0.5 * 0.1);
  EXPECT_DOUBLE_EQ(flux[1][std::size_t(grid.index(1, 0))], -0.1);
  EXPECT_DOUBLE_EQ(flux[1][std::size_t(grid.index(2, 0))], 0.01);
  EXPECT_NEAR(inlet.mean_velocity(0), (0.025 * 0.01 - 0.015 * 0.1) / 0.04, 1e-16);
}

// 20 of 30 mm in at 0.2 m/s, 30 mm out at 0.1: what is left over, 1e-3 m2/s, leaves through 40 mm of the top.
TEST(Inlet, WhatASideBringsLeavesThroughAGivenTop) {
  core::Scene scene;
  scene.inlet = {{{0.0, 0.0}}, {}, core::ColumnEnd::top};
  scene.jets.push_back({{0.005}, {0.025}, {{0.0, 0.2}}, core::ColumnFace::right});
  scene.discharges.push_back({core::ColumnFace::left, {}, {}, {{0.0, 0.1}}});
  const core::Grid grid = bottom(4, 1);
  core::FaceField flux = core::make_face_field(grid);
  Inlet(grid, scene).set_velocity(0, flux);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(flux[1][std::size_t(grid.index(i, 3))], 1e-3 / 0.04, 1e-16);
}

TEST(ColumnFace, HasAnAxisASideAndTheAxesOfItsCorners) {
  using enum core::ColumnFace;
  for (const core::ColumnFace face : {bottom, top, left, right, front, back})
    EXPECT_EQ(core::face_of(axis_of(face), side_of(face)), face) << core::name_of(face);
  EXPECT_EQ(axis_of(left), 0);
  EXPECT_EQ(axis_of(top), 1);
  EXPECT_EQ(axis_of(front), 2);
  EXPECT_EQ(side_of(left), 0);
  EXPECT_EQ(side_of(back), 1);
  EXPECT_EQ(axis_along(left, 2, 0), 1);   // height
  EXPECT_EQ(axis_along(right, 3, 0), 2);  // depth, height
  EXPECT_EQ(axis_along(right, 3, 1), 1);
  EXPECT_EQ(axis_along(front, 3, 0), 0);  // width, height
  EXPECT_EQ(axis_along(front, 3, 1), 1);
  EXPECT_EQ(axis_along(bottom, 3, 1), 2);
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
