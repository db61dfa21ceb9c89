// Small grids and coefficients on their faces, for the tests of the solvers of elliptic equations.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/numerics/linear_solver.hpp"

namespace polybed::core {

inline Grid box(int nx, int ny, bool periodic = false) {
  Grid grid;
  grid.cells = {nx, ny, 1};
  grid.spacing = {1.0 / nx, 2.0 / ny, 1};
  grid.periodic = {periodic, false, false};
  return grid;
}

/// No flux through the walls of an axis on the sides named.
inline void close(const Grid& grid, int axis, bool low, bool high, FaceField& b) {
  const auto a = std::size_t(axis);
  Box faces = owned_cells(grid);
  for (const int layer : {0, grid.cells[a]}) {
    if (layer == 0 ? !low : !high) continue;
    faces.lo[a] = layer;
    faces.hi[a] = layer + 1;
    for_each_row(grid, faces, [&](Index begin, Index end) {
      for (Index f = begin; f < end; ++f) b[a][std::size_t(f)] = 0;
    });
  }
}

template <class Value>
Field cells_of(const Grid& grid, Value&& value) {
  Field field = make_field(grid);
  for (int j = 0; j < grid.cells[1]; ++j)
    for (int i = 0; i < grid.cells[0]; ++i) field[std::size_t(grid.index(i, j))] = value(i, j);
  return field;
}

inline double largest_difference(const Grid& grid, const Field& a, const Field& b) {
  double most = 0;
  for_each_row(grid, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) most = std::max(most, std::abs(a[std::size_t(c)] - b[std::size_t(c)]));
  });
  return most;
}

class ColumnCoefficients : public testing::Test {
 protected:
  static void SetUpTestSuite() { open_linear_solvers(); }
  std::mt19937 random_{3};

  /// Coefficients over three decades, as between a packed bed and clear liquid.
  FaceField rough(const Grid& grid) {
    std::uniform_real_distribution<double> exponent(-3, 0);
    FaceField b = make_face_field(grid);
    for (int a = 0; a < grid.dimensions; ++a)
      for (double& v : b[std::size_t(a)]) v = std::pow(10.0, exponent(random_));
    if (grid.periodic[0])  // the first and the last face across periodic sides are the same face
      for (int j = 0; j < grid.cells[1]; ++j)
        b[0][std::size_t(grid.index(grid.cells[0], j))] = b[0][std::size_t(grid.index(0, j))];
    else
      close(grid, 0, true, true, b);
    return b;
  }
};

}  // namespace polybed::core
