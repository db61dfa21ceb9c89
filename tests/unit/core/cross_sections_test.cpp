#include "core/numerics/cross_sections.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "core/case/scene.hpp"
#include "tests/unit/core/metric_checks.hpp"

namespace polybed::core {
namespace {

using std::numbers::pi;

/// A column of 0.2 m across and `height` m.
Grid grid_of_taper(int cells, int rows, bool rings, double height) {
  Grid grid;
  grid.dimensions = rings ? 2 : 3;
  grid.cells = {cells, rows, rings ? 1 : cells};
  const double h = (rings ? 0.1 : 0.2) / cells;
  grid.spacing = {h, height / rows, rings ? pi * 0.1 : h};
  return grid;
}

double sum_over(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// m3: pi/12 (a^2 + a b + b^2) of height and diameters.
double frustum(double height, double a, double b) { return pi / 12 * height * (a * a + a * b + b * b); }

// A cone, a tube, a step and a cone that narrows, none of which follows the cells.
const Taper uneven{{0, 0.09}, {0.13, 0.2}, {0.17, 0.2}, {0.17, 0.12}, {0.3, 0.11}};
constexpr double volume_of_uneven_parts[4][3] = {{0.13, 0.09, 0.2}, {0.04, 0.2, 0.2}, {0, 0, 0}, {0.13, 0.12, 0.11}};

double diameter_of_uneven(double y) {
  if (y <= 0.13) return 0.09 + 0.11 * y / 0.13;
  return y < 0.17 ? 0.2 : 0.12 - 0.01 * (y - 0.17) / 0.13;
}

// To round-off of sums over at most 1e5 cells.
TEST(TaperedColumn, HasTheVolumeAndTheCrossSectionsOfItsSolidOfRevolution) {
  double volume = 0;
  for (const auto& [height, a, b] : volume_of_uneven_parts) volume += frustum(height, a, b);
  for (const bool rings : {true, false})
    for (const int cells : {16, 29}) {
      const int rows = 37;
      const Grid grid = grid_of_taper(cells, rows, rings, 0.3);
      const std::vector<CrossSection> sections = cross_sections(grid, rings, uneven);
      ASSERT_EQ(sections.size(), std::size_t(rows + 1));
      double found = 0;
      for (int y = 0; y < rows; ++y) found += sum_over(sections[std::size_t(y)].volume) * grid.cell_volume();
      EXPECT_NEAR(found / volume, 1, 1e-12) << cells;
      for (int y = 0; y <= rows; ++y) {
        const double diameter = diameter_of_uneven(y * grid.spacing[1]), whole = grid.spacing[0] * grid.spacing[2];
        EXPECT_NEAR(sum_over(sections[std::size_t(y)].open_y) * whole / (pi / 4 * diameter * diameter), 1, 1e-12)
            << cells << ' ' << y;
      }
    }
}

// By hand: the wall goes from 1.2 to 2.2 cells from the axis. Of the second ring, 3 pi, it leaves
// pi ((2^3 - 1.2^3)/3 - 0.8 + 0.2 x 3) = 1.890667 pi, of the third pi ((2.2^3 - 2^3)/3 - 0.2 x 4) = 0.082667 pi, which
// goes to the second. The face within is open all the way up, the one beyond belongs to what was taken in.
TEST(TaperedColumn, CutsRingsAndAddsSmallOnesToTheNextWithin) {
  Grid grid;
  grid.cells = {4, 1, 1};
  grid.spacing = {1, 1, 4 * pi};
  std::vector<CrossSection> sections = cross_sections(grid, true, {{0, 2.4}, {1, 4.4}});
  CrossSection& layer = sections.front();
  EXPECT_NEAR(layer.volume[0], 1.0 / 4, 1e-15);
  EXPECT_NEAR(layer.volume[1], (1.890667 + 0.082667) / 4, 1e-6 / 4);
  EXPECT_EQ(layer.volume[2], 0);
  EXPECT_NEAR(layer.x_face(1, 0), 2.0 / 4, 1e-15);
  EXPECT_EQ(layer.x_face(2, 0), 0);
  EXPECT_NEAR(layer.open_y[1], (1.2 * 1.2 - 1) / 4, 1e-15);
  EXPECT_NEAR(sections[1].open_y[1], (2.2 * 2.2 - 1) / 4, 1e-15);
  EXPECT_EQ(sections[1].open_y[2], 0);
  // The wall's area of the ring and of what it took in is that of its faces' sum: outwards 2 pi times what the circles
  // add, 0.8 (1.6 - 1) + 0.2 x 1 + 0.2 x 0.1, and the inner face, 1; downwards pi (2.2^2 - 1.2^2).
  const double outwards = 2 * (1 + 0.8 * 0.6 + 0.2 + 0.2 * 0.1), downwards = 2.2 * 2.2 - 1.2 * 1.2;
  // Its distance is half the thickness of what is open, more than the centre's, 0.2 sin 45 degrees.
  const double distance = 0.5 * (1.890667 + 0.082667) / std::hypot(outwards, downwards);
  EXPECT_GT(distance, 0.2 / std::sqrt(2.0));
  EXPECT_NEAR(layer.wall[1], std::hypot(outwards, downwards) / (1.890667 + 0.082667) / distance, 1e-5 * layer.wall[1]);
}

TEST(TaperedColumn, IsTheEvenOneWhereItsDiameterIs) {
  for (const bool rings : {true, false}) {
    const Grid grid = grid_of_taper(9, 4, rings, 0.1);
    const CrossSection even = cross_sections(grid, rings, {}).front();
    const std::vector<CrossSection> layers = cross_sections(grid, rings, {{0, 0.2}, {0.03, 0.2}, {0.1, 0.2}});
    for (std::size_t y = 0; y < layers.size(); ++y)
      for (std::size_t c = 0; c < even.volume.size(); ++c) {
        EXPECT_NEAR(layers[y].open_y[c], even.volume[c], 1e-15);
        if (y == 4) continue;  // what lies on the top has faces alone
        EXPECT_NEAR(layers[y].volume[c], even.volume[c], 1e-14);
        EXPECT_NEAR(layers[y].open_x[c], even.open_x[c], 1e-14);
        EXPECT_NEAR(layers[y].wall[c], even.wall[c], 1e-12 * even.wall[c]);
      }
  }
}

// A step on a face: below it the rings beyond are closed, with their faces; nothing is taken in.
TEST(TaperedColumn, ClosesWhatLiesBeyondAStep) {
  const Grid grid = grid_of_taper(8, 4, true, 0.1);
  std::vector<CrossSection> sections = cross_sections(grid, true, {{0, 0.1}, {0.05, 0.1}, {0.05, 0.2}, {0.1, 0.2}});
  for (int i = 0; i < 8; ++i) {
    const double whole = (2 * i + 1) / 8.0;
    EXPECT_NEAR(sections[1].volume_of(i, 0), i < 4 ? whole : 0, 1e-15);
    EXPECT_NEAR(sections[2].volume_of(i, 0), whole, 1e-15);
    EXPECT_NEAR(sections[2].open_y[std::size_t(i)], i < 4 ? whole : 0, 1e-15);
  }
  EXPECT_EQ(sections[1].x_face(4, 0), 0);
  EXPECT_GT(sections[1].wall[3], 0);
  EXPECT_GT(sections[2].wall[4], 0);  // the floor of the step
}

// No cell is smaller than half a whole one, no ring than 0.15 of one; each has a way out, and a face is open between
// open cells alone.
TEST(TaperedColumn, HasNoSmallCellsAndNoneAlone) {
  for (const bool rings : {true, false}) {
    const int cells = 20, rows = 30;
    const Grid grid = grid_of_taper(cells, rows, rings, 0.3);
    std::vector<CrossSection> sections = cross_sections(grid, rings, uneven);
    for (int y = 0; y < rows; ++y)
      for (int k = 0; k < grid.cells[2]; ++k)
        for (int i = 0; i < cells; ++i) {
          CrossSection &here = sections[std::size_t(y)], &above = sections[std::size_t(y + 1)];
          const double whole = rings ? (2.0 * i + 1) / cells : 1.0, theta = here.volume_of(i, k);
          EXPECT_TRUE(theta == 0 || theta >= ((rings ? 0.15 : 0.5) - 1e-13) * whole) << theta;
          double open = here.open_y[here.at(i, k)] + above.open_y[here.at(i, k)] + here.x_face(i, k);
          if (i + 1 < cells) open += here.x_face(i + 1, k);
          if (!rings) open += here.z_face(i, k) + here.z_face(i, k + 1);
          EXPECT_EQ(theta > 0, open > 0) << i << ' ' << y << ' ' << k;
        }
  }
}

// Heights and volumes of Column: 0.09 to 0.2 m within 0.13 m, then as above.
TEST(TaperedColumn, KnowsWhatLiesBelowAHeight) {
  Column column;
  column.shape = ColumnShape::axisymmetric;
  column.size = {0.1, 0.3, pi * 0.1};
  EXPECT_EQ(column.even_height(0.07), 0.07);
  EXPECT_EQ(column.filled_height(0.07), 0.07);
  column.profile = uneven;
  EXPECT_NEAR(column.cross_section(), pi / 4 * 0.09 * 0.09, 1e-16);
  EXPECT_NEAR(column.even_height(0.065) * column.cross_section(), frustum(0.065, 0.09, 0.145), 1e-16);
  const double below_step = frustum(0.13, 0.09, 0.2) + frustum(0.04, 0.2, 0.2);
  EXPECT_NEAR(column.even_height(0.17) * column.cross_section(), below_step, 1e-15);
  EXPECT_NEAR(column.even_height(0.3) * column.cross_section(), below_step + frustum(0.13, 0.12, 0.11), 1e-15);
  for (const double height : {0.03, 0.13, 0.155, 0.17, 0.25, 0.31})
    EXPECT_NEAR(column.filled_height(column.even_height(height)), height, 1e-14);
}

TEST(TaperedColumn, KeepsWhatItContains) {
  for (const bool rings : {true, false}) {
    Grid grid = grid_of_taper(16, 30, rings, 0.3);
    grid.metric = metric_of(grid, rings ? ColumnShape::axisymmetric : ColumnShape::cylinder, uneven);
    checks::expect_conserving(grid);
  }
}

// A block is a part of the whole column, along the height too.
TEST(TaperedColumn, IsTheSameInBlocks) {
  const Grid grid = grid_of_taper(12, 20, true, 0.3);
  const auto whole = metric_of(grid, ColumnShape::axisymmetric, uneven);
  Grid part = grid;
  part.cells[1] = 7;
  part.before[1] = 6;
  part.after[1] = 7;
  const auto block = metric_of(part, ColumnShape::axisymmetric, uneven);
  checks::expect_part_of(grid, *whole, part, *block);
}

}  // namespace
}  // namespace polybed::core
