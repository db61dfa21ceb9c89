// The pressure's equation where bottom and top are joined: row means, as between other ends.
#include "core/numerics/direct_solver.hpp"
#include "tests/unit/core/column_coefficients.hpp"

namespace polybed::core {
namespace {

class JoinedEnds : public ColumnCoefficients {};

/// Coefficients that differ by a half along a row, and by decades from row to row; the top faces are the bottom ones.
FaceField joined_layers(const Grid& grid, std::mt19937& random) {
  std::uniform_real_distribution<double> value(1.0, 1.5);
  FaceField b = make_face_field(grid);
  for (std::size_t a = 0; a < 2; ++a)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i)
        b[a][std::size_t(grid.index(i, j))] = std::pow(10.0, j % 4) * value(random);
  for (int i = 0; i < grid.cells[0]; ++i)
    b[1][std::size_t(grid.index(i, grid.cells[1]))] = b[1][std::size_t(grid.index(i, 0))];
  for (int j = 0; j < grid.cells[1]; ++j)
    b[0][std::size_t(grid.index(grid.cells[0], j))] = b[0][std::size_t(grid.index(0, j))];
  if (!grid.periodic[0]) close(grid, 0, true, true, b);
  return b;
}

// Also of one and two rows, where both neighbours are the cell itself or one cell; with a constant left open and
// without. Conjugate gradients with a preconditioner within 1.5 of the matrix need at most 16 iterations for 1e-11.
TEST_F(JoinedEnds, ArePreconditionedByRowMeans) {
  for (const bool sides : {false, true})
    for (const int ny : {1, 2, 11}) {
      Grid grid = box(6, ny, sides);
      grid.periodic[1] = true;
      const FaceField b = joined_layers(grid, random_);
      const Field shift = make_field(grid, 1);
      Field source = make_field(grid), iterated = source, direct = source;
      std::uniform_real_distribution<double> value(-1, 1);
      for_each_row(grid, [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c) source[std::size_t(c)] = value(random_);
      });
      PoissonSolver solver(grid);
      const PoissonResult open = solver.solve(spans(b), {}, source, iterated, 1e-11);
      EXPECT_STREQ(open.solver, "PCG + row means");
      EXPECT_TRUE(open.converged) << ny << " " << open.residual;
      EXPECT_LE(open.iterations, 16);
      EXPECT_STREQ(solver.solve(spans(b), shift, source, iterated, 1e-11).solver, "PCG + row means");
      ASSERT_TRUE(solve_directly(grid, spans(b), shift, source, direct));
      double scale = 0;
      for (const double p : direct) scale = std::max(scale, std::abs(p));
      EXPECT_LT(largest_difference(grid, iterated, direct), 1e-8 * scale) << ny;
    }
}

}  // namespace
}  // namespace polybed::core
