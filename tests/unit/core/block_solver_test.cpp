#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/numerics/direct_solver.hpp"
#include "core/numerics/layer_solver.hpp"
#include "core/numerics/linear_solver.hpp"
#include "tests/unit/core/column_coefficients.hpp"

namespace polybed::core {
namespace {

class BlockSolverOfColumns : public ColumnCoefficients {};

// Without the couplings the block system is two equations: p as above, and c q/L - div(C22 grad q). The first must
// come out as the direct solver has it on any width, also where both neighbours of a cell across periodic sides are one
// cell, or the cell itself; the last grid is for multigrid. 1e-6: forty cycles at a factor of 0.7 or better.
TEST_F(BlockSolverOfColumns, TheBlockSystemIsRightOnNarrowPeriodicGrids) {
  for (const auto& [nx, ny] : {std::pair{1, 12}, {2, 9}, {3, 8}, {6, 20}, {70, 75}}) {
    const Grid grid = box(nx, ny, true);
    FaceField b = rough(grid), none = make_face_field(grid), c22 = make_face_field(grid);
    close(grid, 1, true, false, b);
    const Field source = cells_of(grid, [](int i, int j) { return std::sin(i + 2.3 * j); });
    Field p = make_field(grid), q = make_field(grid), direct = make_field(grid);
    BlockSolver solver(grid);
    ASSERT_TRUE(solver.setup(spans(b), spans(none), spans(none), spans(c22), make_field(grid, 1.0), {}, 2.0));
    solver.apply(source, source, p, q, 40);
    ASSERT_TRUE(solve_directly(grid, spans(b), {}, source, direct));
    double scale = 0;
    for (double v : direct) scale = std::max(scale, std::abs(v));
    EXPECT_LT(largest_difference(grid, p, direct), 1e-6 * scale) << nx << " x " << ny;
    Field half = source;
    for (double& v : half) v /= 2;
    EXPECT_LT(largest_difference(grid, q, half), 1e-6) << nx << " x " << ny;
  }
}

// By elimination there is no iteration to converge: as near to the direct solver as in the first test. Layers follow
// each other along the longest axis that is not joined; coefficients vary by three decades from face to face.
TEST_F(BlockSolverOfColumns, LayersAreEliminatedAsTheDirectSolverDoes) {
  for (const auto& [nx, ny, nz, periodic] : {std::tuple{1, 7, 1, false},
                                             {5, 1, 1, false},
                                             {17, 31, 1, false},
                                             {33, 9, 1, false},
                                             {33, 9, 1, true},
                                             {2, 9, 1, true},
                                             {1, 12, 1, true},
                                             {4, 9, 5, false},
                                             {4, 9, 5, true},
                                             {12, 5, 3, false},
                                             {2, 9, 2, true}}) {
    Grid grid = box(nx, ny, periodic);
    grid.dimensions = nz > 1 ? 3 : 2;
    grid.cells[2] = nz;
    grid.spacing[2] = 0.15;
    grid.periodic[2] = periodic && nz > 1;
    FaceField b = rough(grid);
    close(grid, 1, true, false, b);
    if (nz > 1 && !periodic) close(grid, 2, true, true, b);
    if (nz > 1 && periodic)
      for (Index f = 0; f < grid.stride(2); ++f)
        b[2][std::size_t(f + grid.index(0, 0, nz) - grid.index(0, 0, 0) + 2 * grid.stride(2))] =
            b[2][std::size_t(f + 2 * grid.stride(2))];
    Field source = make_field(grid), solved = make_field(grid), direct = make_field(grid);
    std::uniform_real_distribution<double> value(-1, 1);
    for (double& v : source) v = value(random_);
    ASSERT_TRUE(LayerSolver::serves(grid));
    LayerSolver solver(grid);
    solver.setup(spans(b), {});
    solver.solve(source, solved);
    ASSERT_TRUE(solve_directly(grid, spans(b), {}, source, direct));
    double scale = 0;
    for_each_row(grid, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) scale = std::max(scale, std::abs(direct[std::size_t(c)]));
    });
    EXPECT_LT(largest_difference(grid, solved, direct), 1e-9 * scale) << nx << " x " << ny << " x " << nz;
  }
  EXPECT_FALSE(LayerSolver::serves(box(65, 66)));
}

/// What p and q leave of the two equations of BlockSolver; beyond the column's ends both are 0.
struct BlockSystem {
  FaceField c11, c12, c21, c22;
  Field slope;
  double c;

  void subtract(const Grid& grid, Field p, Field q, Field& r1, Field& r2) const {
    const Halo halo(grid);
    for (Field* field : {&p, &q}) halo.exchange(std::span(&field, 1), 0);
    for_each_row(grid, [&](Index begin, Index end) {
      for (Index cell = begin; cell < end; ++cell) {
        const auto here = std::size_t(cell);
        for (std::size_t a = 0; a < std::size_t(grid.dimensions); ++a)
          for (const Index side : {-1, 1}) {
            const auto there = std::size_t(cell + side * grid.stride(int(a))), face = side < 0 ? here : there;
            const double w = 1 / (grid.spacing[a] * grid.spacing[a]);
            const double dp = w * (p[here] - p[there]), dq = w * (q[here] - q[there]);
            r1[here] -= c11[a][face] * dp + c12[a][face] * dq;
            r2[here] -= c21[a][face] * dp + c22[a][face] * dq;
          }
        if (slope[here] > 0)
          r2[here] -= c * q[here] / slope[here];
        else
          r2[here] = q[here];  // which is to be 0 there
      }
    });
  }
};

// Where the share of the flux that solids take is even, one application leaves nothing of either equation, with nothing
// that presses back in the upper half: round-off by elimination, and on the last grid what forty cycles leave.
TEST_F(BlockSolverOfColumns, TheCoupledBlockSystemIsSolvedWhereTheShareIsEven) {
  for (const auto& [nx, ny, periodic, enough] : {std::tuple{1, 20, false, 1e-9},
                                                 {9, 33, false, 1e-9},
                                                 {15, 30, true, 1e-9},
                                                 {40, 16, false, 1e-9},
                                                 {70, 75, false, 1e-5}}) {
    const Grid grid = box(nx, ny, periodic);
    BlockSystem system{rough(grid), rough(grid), rough(grid), rough(grid), make_field(grid), 3.0};
    for (FaceField* coefficient : {&system.c11, &system.c12, &system.c22}) close(grid, 1, true, false, *coefficient);
    for (std::size_t a = 0; a < 2; ++a)
      for (std::size_t f = 0; f < system.c11[a].size(); ++f) {
        system.c21[a][f] = 0.4 * system.c11[a][f];
        system.c22[a][f] += 0.4 * system.c12[a][f];
      }
    for (int j = 0; j < ny / 2; ++j)
      for (int i = 0; i < nx; ++i) system.slope[std::size_t(grid.index(i, j))] = 10.0 * (1 + i % 3);
    const Field source = cells_of(grid, [](int i, int j) { return std::sin(i + 2.3 * j); });
    Field p = make_field(grid), q = make_field(grid), r1 = source, r2 = source;
    BlockSolver solver(grid);
    ASSERT_TRUE(solver.setup(spans(system.c11), spans(system.c12), spans(system.c21), spans(system.c22), system.slope,
                             {}, system.c));
    solver.apply(source, source, p, q, 40);
    system.subtract(grid, p, q, r1, r2);
    const Field zero = make_field(grid);
    EXPECT_LT(largest_difference(grid, r1, zero), enough) << nx << " x " << ny;
    EXPECT_LT(largest_difference(grid, r2, zero), enough) << nx << " x " << ny;
  }
}

}  // namespace
}  // namespace polybed::core
