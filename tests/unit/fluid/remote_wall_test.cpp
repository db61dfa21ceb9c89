// Viscous stress, convection and smoothing far from a wall inside or a port: as without.
#include <gtest/gtest.h>

#include <cmath>

#include "core/case/grading.hpp"
#include "core/numerics/blocks.hpp"
#include "core/numerics/random.hpp"
#include "fluid/convection.hpp"
#include "fluid/smoothing.hpp"
#include "fluid/viscous_stress.hpp"

namespace polybed::fluid {
namespace {

/// Acceleration by viscous stress and by convection of a random velocity that is 0 on closed faces.
core::FaceField acceleration(const core::Grid& grid) {
  const Boundaries boundaries(grid, Ends::walls);
  FluidState fluid(grid);
  for (int axis = 0; axis < grid.dimensions; ++axis)
    core::for_each_row(grid, core::interior_faces(grid, axis), [&](core::Index begin, core::Index end) {
      for (core::Index f = begin; f < end; ++f)
        fluid.velocity[std::size_t(axis)][std::size_t(f)] =
            core::uniform(1, std::uint64_t(axis), std::uint64_t(f)) - 0.5;
    });
  core::hold_closed(grid, fluid.velocity);
  boundaries.fill_velocity(fluid.velocity, WallSlip::no_slip);
  core::FaceField rate = core::make_face_field(grid);
  const auto whole = [](std::size_t, core::Index, core::Index) { return 1.0; };
  convection(grid, boundaries, true, true, fluid.velocity, fluid.velocity, whole, rate);
  add_viscous_stress(grid, boundaries, fluid, {1, 1}, rate);
  return rate;
}

core::Column column_of(core::ColumnShape shape, std::vector<std::pair<double, double>> profile) {
  const bool round = shape == core::ColumnShape::cylinder;
  core::Column column;
  column.shape = shape;
  column.dimensions = round ? 3 : 2;
  column.size = {1, 2, 1};
  column.cells = {16, 32, round ? 16 : 1};
  column.profile = std::move(profile);
  return column;
}

// Four cells away from a ring at half height. Sums of terms of order 1/h^2 = 256; with 1e-13 of that.
TEST(AWallInside, ChangesNothingFarAway) {
  using enum core::ColumnShape;
  const std::vector<std::pair<double, double>> none, cone{{0, 1}, {2, 0.6}}, cone_of_rings{{0, 2}, {2, 1.2}};
  for (const core::Column& column : {column_of(box, none), column_of(cylinder, none), column_of(cylinder, cone),
                                     column_of(axisymmetric, none), column_of(axisymmetric, cone_of_rings)}) {
    SCOPED_TRACE(core::name_of(column.shape));
    const bool flat = column.shape == box;
    const core::InnerWall ring{{0.4, 1}, {0.4, 1.1}, flat ? core::WallShape::rod : core::WallShape::cylinder, 0.15};
    const core::InnerWall rod{{0.4, 1}, {0.4, 1}, core::WallShape::rod, 0.15};
    const auto walls = std::make_shared<const std::vector<core::InnerWall>>(1, flat ? rod : ring);
    const core::Grid empty = core::grid_of(column, nullptr), walled = core::grid_of(column, nullptr, walls);
    const core::FaceField without = acceleration(empty), with = acceleration(walled);
    std::size_t steps = 0;
    for (std::size_t axis = 0; axis < std::size_t(empty.dimensions); ++axis) {
      steps += walled.metric->steps_inside[axis].size();
      core::for_each_row(empty, core::interior_faces(empty, int(axis)), [&](core::Index begin, core::Index end) {
        for (auto f = std::size_t(begin); f < std::size_t(end); ++f) {
          const int row = int(core::Index(f) / empty.stride(1)) % 36 - 2;
          if (std::abs(row - 16) < 8) continue;
          EXPECT_NEAR(with[axis][f], without[axis][f], 1e-10) << axis << ' ' << f;
        }
      });
    }
    EXPECT_GT(steps, 0);
  }
}

/// A layer of solids at half height, smoothed in graded layers: what the axis of the tube has of it, layer by layer.
std::vector<double> spread_layer(const core::Ducts& ducts) {
  core::Column column = column_of(core::ColumnShape::cylinder, {});
  column.layers = core::graded_layers(2, 32, 0.5, 1.1);
  column.cells[1] = int(column.layers.size());
  const core::Grid grid = core::grid_of(column, nullptr, nullptr, ducts);
  core::Field field = core::make_field(grid);
  core::for_each_row(grid, {0, 10, 0}, {16, 11, 16}, [&](core::Index begin, core::Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) field[c] = grid.metric->volume[c] > 0 ? 1 : 0;
  });
  Smoothing(grid, 0.3, true).smooth_cells(field);
  std::vector<double> found;
  for (int j = 0; j < grid.cells[1]; ++j) found.push_back(field[std::size_t(grid.index(8, j, 8))]);
  return found;
}

// A port two layers high far below.
TEST(APort, SmoothsTheGradedTubeAboveItAsWithoutIt) {
  const std::vector<double> without = spread_layer({}), with = spread_layer({{0, 0, {0.4, 0}, {0.6, 0.125}}});
  EXPECT_LT(without[10], 0.5);
  for (std::size_t j = 6; j < without.size(); ++j) EXPECT_NEAR(with[j], without[j], 1e-3) << j;
}

}  // namespace
}  // namespace polybed::fluid
