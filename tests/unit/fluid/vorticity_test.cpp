#include "fluid/vorticity.hpp"

#include <gtest/gtest.h>

#include "core/case/grading.hpp"
#include "core/numerics/blocks.hpp"
#include "fluid/boundaries.hpp"

namespace polybed::fluid {
namespace {

core::Grid grid_of(int dimensions) {
  core::Grid grid;
  grid.dimensions = dimensions;
  grid.cells = {6, 5, dimensions == 3 ? 4 : 1};
  grid.spacing = {0.1, 0.2, 0.25};
  return grid;
}

constexpr double slope[3][3] = {{1, -2, 3}, {4, 5, -6}, {7, -8, 9}};  // dU_i/dx_j, 1/s

/// Of dU_i/dx_j, on all faces that a padded grid has.
core::FaceField linear_velocity(const core::Grid& grid) {
  core::FaceField velocity = core::make_face_field(grid);
  const int ghosts = core::Grid::halo, layers = grid.ghosts(2);
  for (int axis = 0; axis < grid.dimensions; ++axis)
    for (int k = -layers; k < grid.cells[2] + layers; ++k)
      for (int j = -ghosts; j < grid.cells[1] + ghosts; ++j)
        for (int i = -ghosts; i < grid.cells[0] + ghosts; ++i) {
          std::array<double, 3> x{grid.centre(0, i), grid.centre(1, j), grid.centre(2, k)};
          x[std::size_t(axis)] = grid.low(axis, std::array{i, j, k}[std::size_t(axis)]);
          double u = 0;
          for (int along = 0; along < grid.dimensions; ++along) u += slope[axis][along] * x[std::size_t(along)];
          velocity[std::size_t(axis)][std::size_t(grid.index(i, j, k))] = u;
        }
  return velocity;
}

// Differences of numbers of order 10 over distances of order 0.1.
constexpr double round_off = 1e-12;

void expect_that_of_the_slopes(const core::Grid& grid) {
  std::array<core::Field, 3> omega;
  find_vorticity(grid, linear_velocity(grid), omega);
  const bool space = grid.dimensions == 3;
  core::for_each_row(grid, core::owned_cells(grid), [&](core::Index begin, core::Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      EXPECT_NEAR(omega[0][c], space ? -8 - -6 : 0, round_off);
      EXPECT_NEAR(omega[1][c], space ? 3 - 7 : 0, round_off);
      EXPECT_NEAR(omega[2][c], 4 - -2, round_off);
    }
  });
}

TEST(Vorticity, IsExactForVelocitiesThatAreLinear) {
  for (const int dimensions : {2, 3}) expect_that_of_the_slopes(grid_of(dimensions));
}

// Cells that grow from the walls towards the middle, and upwards.
TEST(Vorticity, IsExactInCellsOfAllSizes) {
  core::Column column;
  column.dimensions = 3;
  column.size = {0.6, 1, 1};
  column.cells = {6, 5, 4};
  column.across = {core::graded_widths(0.6, 6, 1.2), core::graded_widths(1, 4, 1.2)};
  column.layers = {0.1, 0.12, 0.18, 0.25, 0.35};
  expect_that_of_the_slopes(core::grid_of(column, nullptr));
}

TEST(Vorticity, HoldsNextToAWallThatHoldsTheFluid) {
  const core::Grid grid = grid_of(2);
  core::FaceField velocity = core::make_face_field(grid);
  for (int j = 0; j < grid.cells[1]; ++j)
    for (int i = 0; i <= grid.cells[0]; ++i) velocity[0][std::size_t(grid.index(i, j))] = 3 * grid.centre(1, j);
  Boundaries(grid, Ends::walls).fill_velocity(velocity, WallSlip::no_slip);
  std::array<core::Field, 3> omega;
  find_vorticity(grid, velocity, omega);
  EXPECT_NEAR(omega[2][std::size_t(grid.index(3, 0))], -3, round_off);
}

}  // namespace
}  // namespace polybed::fluid
