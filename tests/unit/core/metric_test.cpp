#include "core/numerics/metric.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/case/grading.hpp"
#include "core/numerics/operators.hpp"
#include "tests/unit/core/metric_checks.hpp"

namespace polybed::core {
namespace {

using std::numbers::pi;

/// A column of 1 m across.
Grid grid_across(int cells, int dimensions, std::array<int, 3> before = {0, 0, 0}) {
  Grid grid;
  grid.dimensions = dimensions;
  grid.cells = {cells, 4, dimensions == 3 ? cells : 1};
  grid.spacing = {1.0 / cells, 0.1, dimensions == 3 ? 1.0 / cells : pi};
  grid.before = before;
  return grid;
}

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

// Four quarters of a disc: each is pi/4 of its cell, the faces between them are whole, a quarter's chord is sqrt(2)
// times its side.
TEST(RoundColumn, OfFourCellsIsFourQuarters) {
  const auto metric = metric_of(grid_across(2, 3), ColumnShape::cylinder);
  CrossSection section = metric->layers.front();
  for (const double theta : section.volume) EXPECT_NEAR(theta, pi / 4, 1e-14);
  for (int n = 0; n < 2; ++n) {
    EXPECT_NEAR(section.x_face(1, n), 1, 1e-14);
    EXPECT_NEAR(section.z_face(n, 1), 1, 1e-14);
    EXPECT_EQ(section.x_face(0, n), 0);
    EXPECT_EQ(section.z_face(n, 2), 0);
  }
  const double distance = 0.5 - 0.25 * std::sqrt(2.0);  // of the cell's centre from the wall, m
  EXPECT_NEAR(section.wall[0], std::sqrt(2.0) / 0.5 / (pi / 4) / distance, 1e-12 * section.wall[0]);
}

TEST(RoundColumn, HasTheAreaOfItsCircleOnAnyGrid) {
  for (const int cells : {3, 8, 10, 16, 33}) {
    const auto metric = metric_of(grid_across(cells, 3), ColumnShape::cylinder);
    EXPECT_NEAR(sum_of(metric->layers.front().volume) / (cells * cells), pi / 4, 1e-13) << cells;
  }
}

TEST(RoundColumn, IsTheSameTurnedAndMirroredAndHasNoSmallCells) {
  for (const int cells : {8, 13, 16}) {
    CrossSection section = metric_of(grid_across(cells, 3), ColumnShape::cylinder)->layers.front();
    for (int k = 0; k < cells; ++k)
      for (int i = 0; i < cells; ++i) {
        const double theta = section.volume_of(i, k);
        EXPECT_NEAR(theta, section.volume_of(k, i), 1e-13);
        EXPECT_NEAR(theta, section.volume_of(cells - 1 - i, k), 1e-13);
        EXPECT_TRUE(theta == 0 || theta >= 0.5 - 1e-13) << theta;
        const double open =
            section.x_face(i, k) + section.x_face(i + 1, k) + section.z_face(i, k) + section.z_face(i, k + 1);
        EXPECT_EQ(theta > 0, open > 0) << i << ' ' << k;
      }
  }
}

/// Flow of a fluid of unit viscosity under a unit gradient of pressure along a pipe, over Poiseuille's pi R^4/8, less
/// 1: sum alpha (u - u_next)/h^2 + wall theta u = theta, cell by cell.
double excess_flow(int cells) {
  CrossSection section = metric_of(grid_across(cells, 3), ColumnShape::cylinder)->layers.front();
  const double h = 1.0 / cells;
  const Index n = Index(section.volume.size());
  Eigen::MatrixXd equations = Eigen::MatrixXd::Identity(n, n);  // of closed cells
  Eigen::VectorXd volume = Eigen::VectorXd::Zero(n);
  for (int k = 0; k < cells; ++k)
    for (int i = 0; i < cells; ++i) {
      const auto c = Index(section.at(i, k));
      volume[c] = section.volume_of(i, k);
      if (volume[c] == 0) continue;
      equations(c, c) = section.wall[std::size_t(c)] * volume[c] * h * h;
      const auto exchange = [&](double open, Index next) {
        if (open == 0) return;
        equations(c, c) += open;
        equations(c, next) -= open;
      };
      exchange(section.x_face(i, k), c - 1);
      exchange(section.x_face(i + 1, k), c + 1);
      exchange(section.z_face(i, k), c - cells);
      exchange(section.z_face(i, k + 1), c + cells);
    }
  const Eigen::VectorXd u = equations.llt().solve(volume) * h * h;
  return u.dot(volume) * h * h / (pi * std::pow(0.5, 4) / 8) - 1;
}

// The error jumps with how the wall lies in the cells: 4.1 % with 8 cells across, 2 to 3 with 10 to 14, below 1 from 16
// on. A line through its logarithms has the order.
TEST(RoundColumn, ResistsAPipesFlowBetterThanInOrderOneAndAHalf) {
  EXPECT_NEAR(excess_flow(8), 0.04124, 1e-5);
  double x = 0, y = 0, xx = 0, xy = 0, count = 0;
  for (const int cells : {8, 10, 12, 14, 16, 18, 20, 24, 28, 32}) {
    const double error = std::abs(excess_flow(cells)), a = std::log(cells), b = std::log(error);
    if (cells >= 16) {
      EXPECT_LT(error, 0.01) << cells;
    }
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
    ++count;
  }
  EXPECT_GT((x * y - count * xy) / (count * xx - x * x), 1.5);
}

TEST(RoundColumn, KeepsWhatItContains) {
  Grid grid = grid_across(9, 3);
  grid.metric = metric_of(grid, ColumnShape::cylinder);
  checks::expect_conserving(grid);
}

// (1/r) d(r u)/dr of u = r is 2, in every ring.
TEST(Rings, KnowTheDivergenceOfRadialFlow) {
  Grid grid = grid_across(5, 2);
  grid.metric = metric_of(grid, ColumnShape::axisymmetric);
  FaceField flux = make_face_field(grid);
  for (int j = 0; j < grid.cells[1]; ++j)
    for (int i = 0; i <= grid.cells[0]; ++i) flux[0][std::size_t(grid.index(i, j))] = i * grid.spacing[0];
  Field rate = make_field(grid);
  divergence(grid, flux, rate);
  for (int i = 0; i < grid.cells[0]; ++i) EXPECT_NEAR(rate[std::size_t(grid.index(i, 1))], 2, 1e-13);
  // Of the radius R a ring's area is 2 pi r h, over h times the depth pi R: 1/5, 3/5, 1, 7/5, 9/5.
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(grid.metric->layers.front().volume[std::size_t(i)], (2 * i + 1) / 5.0, 1e-15);
  EXPECT_TRUE(grid.metric->around_axis);
}

// A block is a part of the whole column.
TEST(RoundColumn, IsTheSameInBlocks) {
  Grid grid = grid_across(12, 3);
  const auto whole = metric_of(grid, ColumnShape::cylinder);
  Grid part = grid;
  part.cells[0] = 5;
  part.before[0] = 4;
  part.after[0] = 3;
  const auto block = metric_of(part, ColumnShape::cylinder);
  checks::expect_part_of(grid, *whole, part, *block);
}

// A duct of four rows and one layer from the left, one of two rows and two layers from the back. The side of the box is
// open to their rows alone, what is open leads to open cells, and all levels have the area of the circle: a duct is no
// shaft.
TEST(RoundColumn, HasDuctsToItsPorts) {
  constexpr int cells = 12;
  Grid grid = grid_across(cells, 3);
  const Ducts ducts{{0, 0, {0.35, 0.1}, {0.62, 0.2}}, {2, 1, {0.5, 0.15}, {0.65, 0.3}}};
  const auto metric = metric_of(grid, ColumnShape::cylinder, {}, nullptr, ducts);
  const auto theta = [&](Index c) { return metric->volume[std::size_t(c)]; };
  for (int j = 0; j < 4; ++j)
    for (int n = 0; n < cells; ++n) {
      const bool left = j == 1 && n >= 4 && n <= 7, back = (j == 1 || j == 2) && (n == 6 || n == 7);
      EXPECT_EQ(metric->open[0][std::size_t(grid.index(0, j, n))], left ? 1 : 0) << j << ' ' << n;
      EXPECT_EQ(metric->open[2][std::size_t(grid.index(n, j, cells))], back ? 1 : 0) << j << ' ' << n;
      EXPECT_EQ(metric->open[0][std::size_t(grid.index(cells, j, n))], 0);
      EXPECT_EQ(metric->open[2][std::size_t(grid.index(n, j, 0))], 0);
      EXPECT_TRUE(!left || theta(grid.index(0, j, n)) == 1);
    }
  for (int axis = 0; axis < 3; ++axis)
    for_each_row(grid, interior_faces(grid, axis), [&](Index begin, Index end) {
      for (Index f = begin; f < end; ++f) {
        const bool open = metric->open[std::size_t(axis)][std::size_t(f)] > 0;
        EXPECT_TRUE(!open || (theta(f) > 0 && theta(f - grid.stride(axis)) > 0)) << axis << ' ' << f;
      }
    });
  grid.metric = metric;
  for (int level = 0; level <= 4; ++level)
    EXPECT_NEAR(open_faces_below(grid, level) / (cells * cells), pi / 4, 1e-13) << level;
  EXPECT_GT(open_cells_of_layer(grid, 1), open_cells_of_layer(grid, 0));
  EXPECT_NEAR(open_cells_of_layer(grid, 3) / (cells * cells), pi / 4, 1e-13);
  Grid part = grid;
  part.cells[0] = 5;
  part.after[0] = 7;
  const auto block = metric_of(part, ColumnShape::cylinder, {}, nullptr, ducts);
  checks::expect_part_of(grid, *metric, part, *block);
}

// 10 m in 10 layers, graded above 4 m by at most 1.2: 6 m are left. 1.2 + 1.44 + 1.728 = 4.368 m are too little, with
// 2.0736 m more four layers are enough; r + r2 + r3 + r4 = 6 for r = 1.1689595, by Newton's method.
TEST(GradedLayers, GrowByTheLargestRatioThatFits) {
  const std::vector<double> layers = graded_layers(10, 10, 4, 1.2);
  ASSERT_EQ(layers.size(), 8u);
  for (std::size_t n = 0; n < 4; ++n) EXPECT_EQ(layers[n], 1);
  for (std::size_t n = 4; n < 8; ++n) EXPECT_NEAR(layers[n] / layers[n - 1], 1.1689595, 1e-7);
  EXPECT_NEAR(std::accumulate(layers.begin(), layers.end(), 0.0), 10, 1e-13);
}

// The layer in which a height lies is the last of the even ones.
TEST(GradedLayers, StayEvenUpToTheHeight) {
  EXPECT_EQ(graded_layers(10, 10, 4.01, 1.2)[4], 1);
  EXPECT_GT(graded_layers(10, 10, 4, 1.2)[4], 1);
  EXPECT_EQ(graded_layers(0.6, 6, 0.1, 1.2)[0], 0.6 / 6);
  EXPECT_GT(graded_layers(0.6, 6, 0.1, 1.2)[1], 0.1);  // 0.1 m up to round-off
}

TEST(GradedLayers, AreEvenWhereNothingIsLeft) {
  EXPECT_EQ(graded_layers(10, 10, 10, 1.2), std::vector<double>(10, 1.0));
  EXPECT_EQ(graded_layers(10, 10, 9, 1.2), std::vector<double>(10, 1.0));
}

/// Layers of 1, 1, 2 and 4 times 0.1 m, 0.3 m wide.
Grid graded_grid(int dimensions, int before = 0) {
  Grid grid;
  grid.dimensions = dimensions;
  grid.cells = {3, 4, dimensions == 3 ? 2 : 1};
  grid.spacing = {0.1, 0.1, 0.1};
  grid.layers = std::make_shared<const Layers>(Layers{{0.1, 0.1, 0.2, 0.4}, {0, 0.1, 0.2, 0.4, 0.8}});
  if (before > 0) {
    grid.cells[1] -= before;
    grid.before[1] = before;
  }
  grid.metric = metric_of(grid, ColumnShape::box);
  return grid;
}

// By hand: volumes 1, 1, 2, 4 lowest cells; upright faces likewise, level ones 1; distances of centres over 0.1 m: 1,
// 1.5, 3; the volume of a level face's momentum is the mean of both cells.
TEST(GradedMetric, FollowsFromTheHeights) {
  for (const int dimensions : {2, 3}) {
    const Grid grid = graded_grid(dimensions);
    const std::array<double, 4> height{1, 1, 2, 4};
    for (int j = 0; j < 4; ++j) {
      const auto c = std::size_t(grid.index(1, j)), y = std::size_t(j);
      EXPECT_NEAR(grid.metric->volume[c], height[y], 1e-14);
      EXPECT_NEAR(grid.metric->open[0][c], height[y], 1e-14);
      EXPECT_EQ(grid.metric->open[1][c], 1);
      if (dimensions == 3) {
        EXPECT_NEAR(grid.metric->open[2][c], height[y], 1e-14);
      }
      EXPECT_NEAR(grid.metric->per_length[1][c], 1 / height[y], 1e-14);
      EXPECT_NEAR(grid.metric->per_volume_on[0][c], 1 / height[y], 1e-14);
      const double distance = j == 0 ? 1 : 0.5 * (height[y - 1] + height[y]);
      EXPECT_NEAR(grid.metric->per_distance[1][c], 1 / distance, 1e-14);
      EXPECT_NEAR(grid.metric->per_volume_on[1][c], 1 / distance, 1e-14);
      EXPECT_NEAR(open_cells_of_layer(grid, j), height[y] * 3 * grid.cells[2], 1e-13);
    }
    EXPECT_EQ(grid.centre(1, 3), 0.6000000000000001);
    EXPECT_EQ(grid.column_height(), 0.8);
    EXPECT_NEAR(grid.low(1, 6), 1.6, 1e-14);  // continues above the top
    checks::expect_conserving(grid);
  }
}

// By hand: cells of 0.1, 0.15 and 0.1 m by layers of 0.1 m twice and 0.2 m; the sides of a cell over 0.1 m are factors.
TEST(GradedMetric, FollowsFromTheWidths) {
  Grid grid;
  grid.cells = {3, 3, 1};
  grid.spacing = {0.1, 0.1, 1};
  grid.across[0] = std::make_shared<const Layers>(Layers{{0.1, 0.15, 0.1}, {0, 0.1, 0.25, 0.35}});
  grid.layers = std::make_shared<const Layers>(Layers{{0.1, 0.1, 0.2}, {0, 0.1, 0.2, 0.4}});
  grid.metric = metric_of(grid, ColumnShape::box);
  const Metric& metric = *grid.metric;
  const auto middle = std::size_t(grid.index(1, 2));
  EXPECT_NEAR(metric.volume[middle], 3, 1e-14);
  EXPECT_NEAR(metric.open[0][middle], 2, 1e-14);
  EXPECT_NEAR(metric.open[1][middle], 1.5, 1e-14);
  EXPECT_NEAR(metric.per_length[0][middle], 1 / 1.5, 1e-14);
  EXPECT_NEAR(metric.per_distance[0][middle], 1 / 1.25, 1e-14);
  EXPECT_NEAR(metric.per_distance[0][std::size_t(grid.index(0, 2))], 1, 1e-14);  // beyond a wall as beside it
  EXPECT_NEAR(metric.per_volume_on[0][middle], 1 / 2.5, 1e-14);
  EXPECT_NEAR(open_cells_of_layer(grid, 2), 7, 1e-14);
  EXPECT_NEAR(open_faces_below(grid, 2), 3.5, 1e-14);
  EXPECT_NEAR(grid.centre(0, 1), 0.175, 1e-14);
  checks::expect_conserving(grid);
}

TEST(GradedMetric, OfABlockIsItsPartOfTheColumn) {
  const Grid grid = graded_grid(2), part = graded_grid(2, 2);
  for (int j = -1; j < 2; ++j) {
    const auto here = std::size_t(part.index(0, j)), there = std::size_t(grid.index(0, j + 2));
    EXPECT_EQ(part.metric->volume[here], grid.metric->volume[there]);
    EXPECT_EQ(part.metric->per_distance[1][here], grid.metric->per_distance[1][there]);
    EXPECT_EQ(part.centre(1, j), grid.centre(1, j + 2));
  }
}

// The elliptic solvers' equation of equal cells has for p = y2 the source 2 of -div(-grad), times the volume: in a
// layer of height h between b and a, (h + a)/2 and (b + h)/2 apart, A (p_a - p)/d - A (p - p_b)/d = A (y_a + y - y -
// y_b).
TEST(GradedMetric, WeighsTheEllipticEquation) {
  const Grid grid = graded_grid(2);
  FaceField coefficient = make_face_field(grid, 1);
  weigh_faces(grid, coefficient);
  const auto c = std::size_t(grid.index(1, 2)), up = std::size_t(grid.stride(1));
  const auto p = [&](int j) { return grid.centre(1, j) * grid.centre(1, j); };
  const double sum = coefficient[1][c + up] * (p(3) - p(2)) - coefficient[1][c] * (p(2) - p(1));
  EXPECT_NEAR(sum / (0.1 * 0.1), (grid.centre(1, 3) - grid.centre(1, 1)) / 0.1, 1e-12);
}

}  // namespace
}  // namespace polybed::core
