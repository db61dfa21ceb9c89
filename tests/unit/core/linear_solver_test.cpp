#include "core/numerics/linear_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "core/numerics/direct_solver.hpp"
#include "core/numerics/metric.hpp"
#include "tests/unit/core/column_coefficients.hpp"

namespace polybed::core {
namespace {

class LinearSolver : public ColumnCoefficients {};

// Tolerance: both satisfy the equations to 1e-11; the condition number of these grids lies below 1e6 n^2.
TEST_F(LinearSolver, AgreesWithTheDirectSolverOnOddSizesAndPeriodicSides) {
  for (const auto& [nx, ny, periodic] : {std::tuple{1, 7, false},
                                         {3, 5, false},
                                         {17, 31, false},
                                         {16, 32, true},
                                         {18, 33, true},
                                         {2, 9, true},
                                         {1, 12, true},
                                         {5, 1, false}}) {
    const Grid grid = box(nx, ny, periodic);
    FaceField b = rough(grid);
    close(grid, 1, true, false, b);
    const Field source = cells_of(grid, [](int i, int j) { return std::sin(i + 2.3 * j); });
    Field iterated = make_field(grid), direct = make_field(grid);
    PoissonSolver solver(grid);
    const PoissonResult result = solver.solve(spans(b), {}, source, iterated, 1e-11);
    ASSERT_TRUE(result.converged) << nx << " x " << ny;
    ASSERT_TRUE(solve_directly(grid, spans(b), {}, source, direct));
    double scale = 0;
    for (double p : direct) scale = std::max(scale, std::abs(p));
    EXPECT_LT(largest_difference(grid, iterated, direct), 1e-5 * scale) << nx << " x " << ny << " " << result.solver;
  }
}

/// Coefficients that differ by a half along a row, and by decades from row to row; the last face across joined sides is
/// the first one.
FaceField layered(const Grid& grid, std::mt19937& random) {
  std::uniform_real_distribution<double> value(1.0, 1.5);
  FaceField b = make_face_field(grid);
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    Box faces = owned_cells(grid);
    ++faces.hi[a];
    for (int j = faces.lo[1]; j < faces.hi[1]; ++j) {
      Box row = faces;
      row.lo[1] = j;
      row.hi[1] = j + 1;
      for_each_row(grid, row, [&](Index begin, Index end) {
        for (Index f = begin; f < end; ++f) b[a][std::size_t(f)] = std::pow(10.0, j % 4) * value(random);
      });
    }
    if (axis == 1) continue;
    Box last = owned_cells(grid);
    last.lo[a] = grid.cells[a];
    last.hi[a] = grid.cells[a] + 1;
    const Index across = grid.cells[a] * grid.stride(axis);
    for_each_row(grid, last, [&](Index begin, Index end) {
      for (Index f = begin; f < end; ++f)
        if (grid.periodic[a]) b[a][std::size_t(f)] = b[a][std::size_t(f - across)];
    });
    if (!grid.periodic[a]) close(grid, axis, true, true, b);
  }
  close(grid, 1, true, false, b);
  return b;
}

// Rows of cells, walls or joined sides, odd and even numbers of cells, two and three dimensions. Conjugate gradients
// with a preconditioner within 1.5 of the matrix either way need at most 2 sqrt(1.5)/2 ln(2/1e-11) = 16 iterations.
TEST_F(LinearSolver, TakesRowMeansWhereCoefficientsAlongARowAreAlike) {
  for (const bool periodic : {false, true})
    for (const auto& [nx, nz] : {std::pair{1, 1}, {2, 1}, {3, 1}, {20, 1}, {7, 4}, {6, 3}, {2, 2}}) {
      Grid grid = box(nx, 11, periodic);
      grid.dimensions = nz > 1 ? 3 : 2;
      grid.cells[2] = nz;
      grid.spacing[2] = 0.15;
      grid.periodic[2] = periodic && nz > 1;
      const FaceField b = layered(grid, random_);
      Field source = make_field(grid), shift = make_field(grid), iterated = make_field(grid), direct = make_field(grid);
      std::uniform_real_distribution<double> value(-1, 1);
      for_each_row(grid, [&](Index begin, Index end) {
        for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
          source[c] = value(random_);
          shift[c] = 1 + 0.2 * value(random_);
        }
      });
      PoissonSolver solver(grid);
      for (const bool shifted : {false, true}) {
        const std::span<const double> diagonal = shifted ? std::span<const double>(shift) : std::span<const double>();
        const PoissonResult result = solver.solve(spans(b), diagonal, source, iterated, 1e-11);
        EXPECT_STREQ(result.solver, "PCG + row means") << nx << " x " << nz << " " << periodic;
        EXPECT_LE(result.iterations, 16);
        ASSERT_TRUE(solve_directly(grid, spans(b), diagonal, source, direct));
        double scale = 0;
        for (double p : direct) scale = std::max(scale, std::abs(p));
        EXPECT_LT(largest_difference(grid, iterated, direct), 1e-6 * scale) << nx << " x " << nz << " " << periodic;
      }
    }
}

/// Layers of a grid that grow from its spacing on, each a tenth higher than the one below.
std::shared_ptr<const Layers> growing_layers(const Grid& grid) {
  Layers layers{{grid.spacing[1]}, {0, grid.spacing[1]}};
  while (int(layers.height.size()) < grid.cells[1]) {
    layers.height.push_back(1.1 * layers.height.back());
    layers.low.push_back(layers.low.back() + layers.height.back());
  }
  return std::make_shared<const Layers>(layers);
}

// Alike in every row: the means are the coefficients, and one iteration solves to round-off. Layers even or graded.
TEST_F(LinearSolver, TakesOneIterationOnRowsThatAreEven) {
  for (const bool graded : {false, true}) {
    Grid grid = box(12, 30);
    if (graded) grid.layers = growing_layers(grid);
    grid.metric = metric_of(grid, ColumnShape::box);
    FaceField b = make_face_field(grid);
    for (int axis = 0; axis < 2; ++axis)
      for (int j = 0; j <= 30; ++j)
        for (int i = 0; i <= 12; ++i) b[std::size_t(axis)][std::size_t(grid.index(i, j))] = 1 + 0.5 * std::sin(j);
    close(grid, 0, true, true, b);
    close(grid, 1, true, false, b);
    weigh_faces(grid, b);
    Field source = cells_of(grid, [](int i, int j) { return std::sin(i * i + 2.3 * j); });
    weigh_cells(grid, source);
    Field p = make_field(grid);
    PoissonSolver solver(grid);
    const PoissonResult result = solver.solve(spans(b), {}, source, p, 1e-10);
    EXPECT_TRUE(result.converged) << graded;
    EXPECT_EQ(result.iterations, 1) << graded;
  }
}

/// A tube cut out of cells that are as deep as wide or not, odd and even numbers of them.
Grid tube(int across, int deep, int layers, const Ducts& ducts = {}) {
  Grid grid = box(across, layers);
  grid.dimensions = 3;
  grid.cells[2] = deep;
  grid.spacing[2] = 1.0 / deep;
  grid.metric = metric_of(grid, ColumnShape::cylinder, {}, nullptr, ducts);
  return grid;
}

/// One at the left in two layers, one at the back up to the top.
Ducts two_ducts(const Grid& grid) {
  const double height = grid.cells[1] * grid.spacing[1], width = grid.cells[0] * grid.spacing[0];
  return {{0, 0, {0.2, 0.2 * height}, {0.8, 0.4 * height}}, {2, 1, {0.4 * width, 0.6 * height}, {0.7 * width, height}}};
}

// The bound of rows of cells, 16 iterations, holds where a wall cuts them. Open and closed above, with and without
// ports.
TEST_F(LinearSolver, TakesTheModesOfARoundSection) {
  for (const auto& [nx, nz, ports] :
       {std::tuple{6, 6, false}, {7, 7, false}, {9, 6, false}, {6, 6, true}, {9, 6, true}, {14, 14, true}})
    for (const bool open : {true, false}) {
      Grid grid = tube(nx, nz, 10);
      if (ports) grid = tube(nx, nz, 10, two_ducts(grid));
      FaceField b = layered(grid, random_);
      if (!open) close(grid, 1, true, true, b);
      weigh_faces(grid, b);
      Field source = make_field(grid), iterated = source, direct = source;
      std::uniform_real_distribution<double> value(-1, 1);
      for (double& s : source) s = value(random_);
      double sum = 0, volume = 0;
      for_each_row(grid, [&](Index begin, Index end) {
        for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
          sum += grid.metric->volume[c] * source[c];
          volume += grid.metric->volume[c];
        }
      });
      if (!open)  // what flows into a closed tube also leaves it
        for (double& s : source) s -= sum / volume;
      weigh_cells(grid, source);
      PoissonSolver solver(grid);
      const PoissonResult result = solver.solve(spans(b), {}, source, iterated, 1e-11);
      EXPECT_STREQ(result.solver, "PCG + row means") << nx << " x " << nz << " " << open << " " << ports;
      EXPECT_LE(result.iterations, 16) << nx << " x " << nz << " " << open << " " << ports;
      if (!open) continue;  // p is then known but for a constant
      ASSERT_TRUE(solve_directly(grid, spans(b), {}, source, direct));
      double most = 0, scale = 0;
      for_each_row(grid, [&](Index begin, Index end) {
        for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
          if (!(grid.metric->volume[c] > 0)) continue;
          most = std::max(most, std::abs(iterated[c] - direct[c]));
          scale = std::max(scale, std::abs(direct[c]));
        }
      });
      EXPECT_LT(most, 1e-6 * scale) << nx << " x " << nz;
    }
}

// Also in graded layers, where the billionth that closed faces keep grows with the height of the layer. Ports add the
// few iterations by which the equation around them acts on the rest.
TEST_F(LinearSolver, TakesOneIterationInATubeThatIsEven) {
  for (const auto& [graded, ports] : {std::pair{false, false}, {true, false}, {false, true}, {true, true}}) {
    Grid grid = tube(8, 8, 12);
    if (graded) grid.layers = growing_layers(grid);
    grid.metric = metric_of(grid, ColumnShape::cylinder, {}, nullptr, ports ? two_ducts(grid) : Ducts());
    FaceField b = make_face_field(grid);
    for (std::size_t a = 0; a < 3; ++a)
      for (int k = 0; k <= 8; ++k)
        for (int j = 0; j <= 12; ++j)
          for (int i = 0; i <= 8; ++i) b[a][std::size_t(grid.index(i, j, k))] = 1 + 0.5 * std::sin(j);
    for (const int axis : {0, 2}) close(grid, axis, true, true, b);
    close(grid, 1, true, false, b);
    weigh_faces(grid, b);
    Field source = make_field(grid), p = source;
    std::uniform_real_distribution<double> value(-1, 1);
    for (double& s : source) s = value(random_);
    weigh_cells(grid, source);
    PoissonSolver solver(grid);
    const PoissonResult result = solver.solve(spans(b), {}, source, p, 1e-10);
    EXPECT_TRUE(result.converged) << graded << ports;
    EXPECT_STREQ(result.solver, "PCG + row means") << graded << ports;
    EXPECT_LE(result.iterations, ports ? 8 : 1) << graded << ports;
  }
}

// The same in three dimensions, walls or joined sides.
TEST_F(LinearSolver, AgreesWithTheDirectSolverInThreeDimensions) {
  for (const bool periodic : {false, true}) {
    Grid grid = box(6, 9, periodic);
    grid.dimensions = 3;
    grid.cells[2] = 5;
    grid.spacing[2] = 0.15;
    grid.periodic[2] = periodic;
    FaceField b = make_face_field(grid);
    std::uniform_real_distribution<double> value(0.1, 1.0);
    for (Field& faces : b)
      for (double& v : faces) v = value(random_);
    close(grid, 1, true, false, b);
    for (const int axis : {0, 2}) {
      const auto a = std::size_t(axis);
      const Index across = grid.cells[a] * grid.stride(axis);
      Box last = owned_cells(grid);
      last.lo[a] = grid.cells[a];
      last.hi[a] = grid.cells[a] + 1;
      for_each_row(grid, last, [&](Index begin, Index end) {
        for (Index f = begin; f < end; ++f) b[a][std::size_t(f)] = b[a][std::size_t(f - across)];
      });
      if (!periodic) close(grid, axis, true, true, b);
    }
    Field source = make_field(grid), iterated = source, direct = source;
    for (double& v : source) v = value(random_);
    PoissonSolver solver(grid);
    ASSERT_TRUE(solver.solve(spans(b), {}, source, iterated, 1e-11).converged);
    ASSERT_TRUE(solve_directly(grid, spans(b), {}, source, direct));
    EXPECT_LT(relative_residual(grid, Halo(grid), spans(b), {}, source, direct), 1e-12);
    EXPECT_LT(relative_residual(grid, Halo(grid), spans(b), {}, source, iterated), 1e-10);
    double most = 0, scale = 0;
    for_each_row(grid, [&](Index begin, Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
        most = std::max(most, std::abs(iterated[c] - direct[c]));
        scale = std::max(scale, std::abs(direct[c]));
      }
    });
    EXPECT_LT(most, 1e-8 * scale) << periodic;
  }
}

// Cells of 8 to 1: the algebraic multigrid takes over, and needs a few iterations.
TEST_F(LinearSolver, LongCellsAreForTheAlgebraicMultigrid) {
  for (const bool periodic : {false, true}) {
    Grid grid = box(24, 24, periodic);
    grid.spacing = {1.0, 8.0, 1.0};
    FaceField b = rough(grid);
    close(grid, 1, true, false, b);
    const Field source = cells_of(grid, [](int i, int j) { return std::sin(i + 2.3 * j); });
    Field iterated = make_field(grid), direct = make_field(grid);
    PoissonSolver solver(grid);
    const PoissonResult result = solver.solve(spans(b), {}, source, iterated, 1e-10);
    EXPECT_TRUE(result.converged);
    EXPECT_STREQ(result.solver, "PCG + BoomerAMG");
    EXPECT_LT(result.iterations, 40);
    ASSERT_TRUE(solve_directly(grid, spans(b), {}, source, direct));
    double scale = 0;
    for (double p : direct) scale = std::max(scale, std::abs(p));
    EXPECT_LT(largest_difference(grid, iterated, direct), 1e-5 * scale);
  }
}

// p = cos(pi x) sin(pi y / 2 ...) with p = 0 half a cell above the top: second order in the cell size.
TEST_F(LinearSolver, ConvergesToASmoothSolutionInSecondOrder) {
  double before = 0;
  for (const int n : {16, 32, 64}) {
    const Grid grid = box(n, 2 * n);
    FaceField b = make_face_field(grid, 1.0);
    close(grid, 0, true, true, b);
    close(grid, 1, true, false, b);
    const double top = 2 + 0.5 * grid.spacing[1], k = std::numbers::pi / 2 / top, w = std::numbers::pi;
    const auto exact = [&](int i, int j) { return std::cos(w * grid.centre(0, i)) * std::cos(k * grid.centre(1, j)); };
    const Field source = cells_of(grid, [&](int i, int j) { return (w * w + k * k) * exact(i, j); });
    Field p = make_field(grid);
    PoissonSolver solver(grid);
    ASSERT_TRUE(solver.solve(spans(b), {}, source, p, 1e-12).converged);
    const double error = largest_difference(grid, p, cells_of(grid, exact));
    if (before > 0) {
      EXPECT_NEAR(std::log2(before / error), 2.0, 0.1) << n;
    }
    before = error;
  }
}

// Without an outlet p is known up to a constant: the mean is 0, and what the source lacks in balance is left out.
TEST_F(LinearSolver, AClosedBoxIsSolvedWithMeanZero) {
  const Grid grid = box(12, 20);
  FaceField b = rough(grid);
  close(grid, 1, true, true, b);
  const Field source = cells_of(grid, [](int i, int j) { return 1.0 + std::cos(i) * std::sin(3.0 * j); });
  Field p = make_field(grid);
  PoissonSolver solver(grid);
  const PoissonResult result = solver.solve(spans(b), {}, source, p, 1e-10);
  EXPECT_TRUE(result.converged);
  double sum = 0, size = 0;
  for_each_row(grid, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      sum += p[std::size_t(c)];
      size += std::abs(p[std::size_t(c)]);
    }
  });
  EXPECT_LT(std::abs(sum), 1e-12 * size);
}

// The trap: a hierarchy kept from other coefficients can stop at once and report a residual of 0. The bubble
// moves by one cell; the solution must be that of the new coefficients.
TEST_F(LinearSolver, ABubbleThatMovesIsSeen) {
  const Grid grid = box(20, 40);
  const Field source = cells_of(grid, [](int i, int j) { return std::sin(0.3 * i) + std::cos(0.2 * j); });
  PoissonSolver solver(grid);
  Field p = make_field(grid);
  for (int shift = 0; shift < 6; ++shift) {
    FaceField b = make_face_field(grid, 1e-3);
    close(grid, 0, true, true, b);
    close(grid, 1, true, false, b);
    for (int j = 10 + shift; j < 20 + shift; ++j)
      for (int i = 6; i < 13; ++i)
        for (std::size_t a = 0; a < 2; ++a) b[a][std::size_t(grid.index(i, j))] = 1;
    const PoissonResult result = solver.solve(spans(b), {}, source, p, 1e-6);
    ASSERT_TRUE(result.converged);
    EXPECT_LE(relative_residual(grid, Halo(grid), spans(b), {}, source, p), 2e-6) << shift;
  }
}

TEST_F(LinearSolver, ASourceOfZeroGivesZero) {
  const Grid grid = box(8, 16);
  FaceField b = rough(grid);
  close(grid, 1, true, false, b);
  Field p = make_field(grid, 1.0);
  PoissonSolver solver(grid);
  const PoissonResult result = solver.solve(spans(b), {}, make_field(grid), p, 1e-8);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(largest_difference(grid, p, make_field(grid)), 1e-12);
}

// The stages of a step start from each other's pressure. hypre tests after an iteration, so one is the least.
TEST_F(LinearSolver, AnExactFirstGuessCostsOneIteration) {
  const Grid grid = box(16, 32);
  FaceField b = rough(grid);
  close(grid, 1, true, false, b);
  const Field source = cells_of(grid, [](int i, int j) { return std::sin(1.0 * i * j); });
  Field p = make_field(grid);
  PoissonSolver solver(grid);
  const int cold = solver.solve(spans(b), {}, source, p, 1e-10).iterations;
  EXPECT_GT(cold, 3);
  EXPECT_LE(solver.solve(spans(b), {}, source, p, 1e-8).iterations, 1);
}

// With a shift the closed box has one solution, and the shift alone gives p = source / shift.
TEST_F(LinearSolver, TheShiftActs) {
  const Grid grid = box(9, 14);
  FaceField b = make_face_field(grid);
  const Field shift = make_field(grid, 4.0);
  const Field source = cells_of(grid, [](int i, int j) { return i - 2.0 * j; });
  Field p = make_field(grid);
  PoissonSolver solver(grid);
  ASSERT_TRUE(solver.solve(spans(b), shift, source, p, 1e-12).converged);
  EXPECT_LT(largest_difference(grid, p, cells_of(grid, [](int i, int j) { return (i - 2.0 * j) / 4; })), 1e-11);
}

}  // namespace
}  // namespace polybed::core
