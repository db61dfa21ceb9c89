#include "core/numerics/operators.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace polybed::core {
namespace {

using std::numbers::pi;

/// A periodic row of cell means of sin(2 pi x) on [0, 1], ghosts filled.
struct Row {
  explicit Row(int n) : cells(n), q(std::size_t(n + 4)) {
    const double h = 1.0 / n;
    for (int i = -2; i < n + 2; ++i)
      q[std::size_t(i + 2)] = (std::cos(2 * pi * i * h) - std::cos(2 * pi * (i + 1) * h)) / (2 * pi * h);
  }
  int cells;
  std::vector<double> q;
};

/// Mean error of d/dx of the cell means by face values of a scheme.
template <class Face>
double error_of_divergence(int n, double velocity) {
  const Row row(n);
  const double h = 1.0 / n;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double* q = row.q.data();
    const double flux = Face::at(q, i + 3, 1, velocity) - Face::at(q, i + 2, 1, velocity);
    const double exact = std::sin(2 * pi * (i + 1) * h) - std::sin(2 * pi * i * h);
    sum += std::abs(flux - exact) / h;
  }
  return sum / n;
}

template <class Face>
double order(double velocity) {
  return std::log2(error_of_divergence<Face>(128, velocity) / error_of_divergence<Face>(256, velocity));
}

// Order in the mean: upwind 1; the limited scheme 2 on smooth flow, a little less because the limiter sees
// the two extrema (one cell each, first order: h^2 in the mean).
TEST(Convection, OrdersOnASmoothProfile) {
  for (const double velocity : {1.0, -1.0}) {
    EXPECT_NEAR(order<UpwindFace>(velocity), 1.0, 0.05);
    EXPECT_NEAR(order<LimitedFace>(velocity), 2.0, 0.25);
  }
}

/// Mean error of -(U.grad)U along x for U = (sin 2 pi x cos 2 pi y, cos 2 pi x sin 2 pi y) on n x n cells.
double error_of_convection(int n) {
  Grid grid;
  grid.cells = {n, n, 1};
  grid.spacing = {1.0 / n, 1.0 / n, 1};
  grid.periodic = {true, true, false};
  const double h = 1.0 / n, k = 2 * pi;
  FaceField u = make_face_field(grid);
  for (int j = -2; j < n + 2; ++j)
    for (int i = -2; i < n + 2; ++i) {
      const auto c = std::size_t(grid.index(i, j));
      u[0][c] = std::sin(k * i * h) * std::cos(k * (j + 0.5) * h);
      u[1][c] = std::cos(k * (i + 0.5) * h) * std::sin(k * j * h);
    }
  Field rate = make_field(grid);
  subtract_convection(grid, u, 0, owned_cells(grid), rate);
  double sum = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = k * i * h, y = k * (j + 0.5) * h;
      // u du/dx + v du/dy = k sin x cos x cos^2 y - k cos x sin x sin^2 y
      const double exact = k * std::sin(x) * std::cos(x) * (std::cos(y) * std::cos(y) - std::sin(y) * std::sin(y));
      sum += std::abs(rate[std::size_t(grid.index(i, j))] + exact);
    }
  return sum / (double(n) * n);
}

// As on the outlet's faces.
TEST(Convection, IsOfFirstOrderOnASmoothVortexAsUGradU) {
  EXPECT_NEAR(std::log2(error_of_convection(64) / error_of_convection(128)), 1.0, 0.05);
}

TEST(Convection, FaceValuesStayBetweenTheirNeighbours) {
  const std::vector<double> q{0, 0, 1, 1, 0.2, 0.9, 0, 0, 0.62, 0.62};
  for (Index c = 2; c + 1 < Index(q.size()); ++c)
    for (const double velocity : {1.0, -1.0}) {
      const double face = LimitedFace::at(q.data(), c, 1, velocity);
      EXPECT_GE(face, std::min(q[std::size_t(c - 1)], q[std::size_t(c)]));
      EXPECT_LE(face, std::max(q[std::size_t(c - 1)], q[std::size_t(c)]));
    }
}

// The limiter scales with its arguments, so that a species may be cut in two; and it is exact on straight lines.
TEST(Limiter, ScalesAndKeepsStraightLines) {
  EXPECT_EQ(limited_slope(2.0, 2.0), 2.0);
  EXPECT_EQ(limited_slope(1.0, -1.0), 0.0);
  EXPECT_EQ(limited_slope(0.0, 0.0), 0.0);
  EXPECT_EQ(limited_slope(0.25 * 3, 0.25 * 5), 0.25 * limited_slope(3, 5));
  EXPECT_EQ(limited_slope(1e-200, 1e-200), 0.0) << "below the square root of the least number nothing is left";
}

}  // namespace
}  // namespace polybed::core
