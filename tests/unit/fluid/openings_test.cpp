#include "fluid/openings.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace polybed::fluid {
namespace {

constexpr int nx = 4, ny = 3;

core::Grid column() {
  core::Grid grid;
  grid.cells = {nx, ny, 1};
  grid.spacing = {0.01, 0.02, 0.005};
  return grid;
}

/// Species a is fed from below into 5 to 20 mm, b from above everywhere; the outlet is open.
core::Scene scene_with_feeds() {
  core::Scene scene;
  scene.species.resize(2);
  scene.species[0].name = "a";
  scene.species[1].name = "b";
  scene.column.outlet = core::Outlet::open;
  scene.feeds.push_back({"a", core::ColumnFace::bottom, {{0.0, 0.01}, {1.0, 0.03}}, 0.1, {0.005}, {0.02}});
  scene.feeds.push_back({"b", core::ColumnFace::top, {{0.0, 0.004}}, 0.2, {}, {}});
  return scene;
}

struct Ends : testing::Test {
  core::Grid grid = column();
  Openings openings{grid, scene_with_feeds()};
  Interphase solids{grid, {2000.0, 3000.0}};
  core::FaceField flux = core::make_face_field(grid, 7.0);
  void SetUp() override {
    solids.passed.assign(2, core::make_face_field(grid));
    solids.passed_rate = solids.passed;
    for (core::Field& phi : solids.fraction) std::fill(phi.begin(), phi.end(), 0.3);
    for (auto& u : solids.velocity) std::fill(u[1].begin(), u[1].end(), 0.5);
  }
  [[nodiscard]] std::size_t at(int i, int j) const { return std::size_t(grid.index(i, j)); }
};

TEST_F(Ends, AFeedHasItsAreaItsFractionAndItsVelocity) {
  openings.set_velocities(0.5, solids);
  openings.set_ghosts(0.5, solids);
  openings.cross(0.5, 0, solids, flux);
  EXPECT_EQ(flux[1][at(2, 0)], 0);                  // 20 to 30 mm: nothing
  EXPECT_DOUBLE_EQ(flux[1][at(0, 0)], 0.5 * 0.02);  // half of 0 to 10 mm
  EXPECT_DOUBLE_EQ(flux[1][at(1, 0)], 0.02);        // half-way from 0.01 to 0.03
  EXPECT_EQ(solids.velocity[0][1][at(1, 0)], 0.1);
  EXPECT_EQ(solids.velocity[0][1][at(2, 0)], 0.5);  // not touched
  // The mean of ghost and cell is the fraction of the feed, 0.02/0.1.
  EXPECT_NEAR(0.5 * (solids.fraction[0][at(1, -1)] + solids.fraction[0][at(1, 0)]), 0.2, 1e-15);
  EXPECT_EQ(solids.passed_rate[0][1][at(1, 0)], flux[1][at(1, 0)]);
  openings.set_rate_ghosts(0.5, 0, solids);  // of 0.02 m/s2 over 0.1 m/s, the cell at rest
  EXPECT_NEAR(solids.fraction_rate[0][at(1, -1)], 2 * 0.02 / 0.1, 1e-15);
}

TEST_F(Ends, AnOpenOutletLetsOutAndNeverIn) {
  solids.velocity[0][1][at(1, ny)] = -0.5;
  openings.cross(0, 0, solids, flux);
  EXPECT_DOUBLE_EQ(flux[1][at(0, ny)], 0.15);
  EXPECT_EQ(flux[1][at(1, ny)], 0);
  openings.cross(0, 1, solids, flux);  // b is fed there: down, not out
  EXPECT_DOUBLE_EQ(flux[1][at(0, ny)], -0.004);
  EXPECT_EQ(flux[1][at(0, 0)], 0);
}

TEST_F(Ends, WhatIsFedIsHeld) {
  EXPECT_TRUE(openings.holds(0, 1, grid.index(0, 0)));
  EXPECT_FALSE(openings.holds(0, 1, grid.index(2, 0)));
  EXPECT_FALSE(openings.holds(0, 1, grid.index(0, ny)));
  EXPECT_TRUE(openings.holds(1, 1, grid.index(3, ny)));
  for (auto& a : solids.acceleration) std::fill(a[1].begin(), a[1].end(), 1.0);
  openings.hold(solids.acceleration);
  EXPECT_EQ(solids.acceleration[1][1][at(0, ny)], 0);
  EXPECT_EQ(solids.acceleration[0][1][at(0, ny)], 1);
  core::FaceField mobility = core::make_face_field(grid, 1.0);
  openings.hold(solids, mobility);
  EXPECT_DOUBLE_EQ(mobility[1][at(0, ny)], 1 - 0.3 / 3000);
  EXPECT_EQ(mobility[1][at(0, 0)], 1);
}

TEST_F(Ends, WhatHasPassedIsInOrOut) {
  for (const int i : {0, 1}) solids.passed[0][1][at(i, 0)] = 2;
  for (int i = 0; i < nx; ++i) {
    solids.passed[0][1][at(i, ny)] = 3;
    solids.passed[1][1][at(i, ny)] = -1;
  }
  const std::vector<Passed> passed = openings.passed(solids);
  constexpr double area = 0.01 * 0.005;
  EXPECT_DOUBLE_EQ(passed[0].in, 2 * 2 * area);
  EXPECT_DOUBLE_EQ(passed[0].out, 4 * 3 * area);
  EXPECT_DOUBLE_EQ(passed[1].in, 4 * 1 * area);
  EXPECT_EQ(passed[1].out, 0);
  EXPECT_EQ(openings.passages().size(), 3U);
  EXPECT_EQ(openings.greatest(), 0.2);
  EXPECT_EQ(openings.breakpoints(), (std::vector<double>{0.0, 1.0}));
}

// a is fed from the left at 0.01 m/s of solids, moving at 0.1; both leave to the right at 0.2 m/s of the mixture.
TEST(Sides, LetInWhatIsFedAndOutWhatIsThere) {
  const core::Grid grid = column();
  core::Scene scene = scene_with_feeds();
  scene.column.outlet = core::Outlet::screen;
  scene.feeds = {{"a", core::ColumnFace::left, {{0.0, 0.01}}, 0.1, {0.02}, {0.04}}};
  scene.discharges = {{core::ColumnFace::right, {0.0}, {0.03}, {{0.0, 0.2}}}};
  const Openings openings(grid, scene);
  EXPECT_TRUE(openings.in_sides());
  EXPECT_EQ(openings.passages().size(), 3U);  // a left and right, b right
  Interphase solids{grid, {2000.0, 3000.0}};
  solids.passed.assign(2, core::make_face_field(grid));
  solids.passed_rate = solids.passed;
  std::fill(solids.fraction[0].begin(), solids.fraction[0].end(), 0.3);
  std::fill(solids.fraction[1].begin(), solids.fraction[1].end(), 0.2);
  core::FaceField flux = core::make_face_field(grid, 7.0);
  const auto at = [&](int i, int j) { return std::size_t(grid.index(i, j)); };
  openings.set_velocities(0, solids);
  openings.set_ghosts(0, solids);
  openings.cross(0, 0, solids, flux);
  EXPECT_EQ(flux[0][at(0, 1)], 0.01);
  EXPECT_NEAR(0.5 * (solids.fraction[0][at(-1, 1)] + solids.fraction[0][at(0, 1)]), 0.1, 1e-15);
  EXPECT_EQ(solids.velocity[0][0][at(0, 1)], 0.1);
  EXPECT_EQ(solids.velocity[0][0][at(-1, 1)], 0.1) << "beyond";
  EXPECT_EQ(solids.velocity[1][0][at(0, 1)], 0);
  EXPECT_DOUBLE_EQ(flux[0][at(nx, 0)], 0.3 * 0.2);
  EXPECT_DOUBLE_EQ(flux[0][at(nx, 1)], 0.3 * 0.5 * 0.2);  // half of it is wall
  EXPECT_DOUBLE_EQ(solids.velocity[1][0][at(nx, 1)], 0.1);
  openings.cross(0, 1, solids, flux);
  EXPECT_EQ(flux[0][at(0, 1)], 0);
  EXPECT_DOUBLE_EQ(flux[0][at(nx, 0)], 0.2 * 0.2);
  EXPECT_DOUBLE_EQ(solids.passed_rate[0][0][at(nx, 0)], 0.3 * 0.2);
  solids.passed[0][0][at(0, 1)] = 2;
  solids.passed[0][0][at(nx, 0)] = 3;
  solids.passed[1][0][at(nx, 0)] = 4;
  const std::vector<Passed> passed = openings.passed(solids);
  constexpr double area = 0.02 * 0.005;
  EXPECT_DOUBLE_EQ(passed[0].in, 2 * area);
  EXPECT_DOUBLE_EQ(passed[0].out, 3 * area);
  EXPECT_DOUBLE_EQ(passed[1].out, 4 * area);
  EXPECT_EQ(passed[1].in, 0);
}

TEST(Screens, AreAbsent) {
  core::Scene scene = scene_with_feeds();
  scene.feeds.clear();
  scene.column.outlet = core::Outlet::screen;
  EXPECT_FALSE(Openings(column(), scene).present());
  scene.column.outlet = core::Outlet::open;
  EXPECT_TRUE(Openings(column(), scene).present());
  scene.column.closed = true;
  EXPECT_FALSE(Openings(column(), scene).present());
}

// Share 0.5, h 0.1 m: outwards at 2 m/s after 0.5 m/s inside -0.5 2 (2 - 0.5)/0.1; inwards from rest 0.5 2 2/0.1.
TEST(OpenFace, SlowsWhatComesInFromRest) {
  const OpenFace right{core::ColumnFace::right, 1, 0, 1, 0, 0.5, 1, 0.1, 0};
  EXPECT_DOUBLE_EQ(right.convection({0, 1}, {0.5, 0}), -15);
  EXPECT_DOUBLE_EQ(right.convection({0, -1}, {-0.5, 0}), 20);
  const OpenFace left{core::ColumnFace::left, 0, 0, 0, 1, 0.5, -1, 0.1, 0};
  EXPECT_DOUBLE_EQ(left.convection({-1, 0}, {0, -0.5}), 15);
  EXPECT_DOUBLE_EQ(left.convection({1, 0}, {0, 0.5}), -20);
}

}  // namespace
}  // namespace polybed::fluid
