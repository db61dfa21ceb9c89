#include <vector>

#include "core/numerics/direct_solver.hpp"
#include "core/numerics/hypre_rows.hpp"
#include "core/numerics/linear_solver.hpp"
#include "core/numerics/ranks.hpp"

namespace polybed::core {

/// The two unknowns of a cell stand next to each other.
struct BlockSolver::Hypre {
  HypreRows rows;
  std::vector<double> packed;
  explicit Hypre(const Grid& grid) : rows(grid, 2), packed(2 * grid.cell_count()) {}
};

BlockSolver::BlockSolver(const Grid& grid) : grid_(grid), hypre_(std::make_unique<Hypre>(grid)) {}
BlockSolver::~BlockSolver() = default;
BlockSolver::BlockSolver(BlockSolver&&) noexcept = default;
BlockSolver& BlockSolver::operator=(BlockSolver&&) noexcept = default;

bool BlockSolver::setup(const FaceSpans& c11, const FaceSpans& c12, const FaceSpans& c21, const FaceSpans& c22,
                        const Field& slope, const Field& diagonal_p, double c) {
  HypreRows& rows = hypre_->rows;
  rows.begin();
  /// Flux of one unknown's equation through one face of a cell: there, and to the cell beyond.
  const auto couple = [&](Index cell, Index beyond, double of_p, double of_s) {
    rows.add(rows.row_of(cell), of_p);
    rows.add(rows.row_of(cell) + 1, of_s * slope[std::size_t(cell)]);
    if (rows.row_of(beyond) < 0) return;
    rows.add(rows.row_of(beyond), -of_p);
    rows.add(rows.row_of(beyond) + 1, -of_s * slope[std::size_t(beyond)]);
  };
  const double pin = diagonal_p.empty() ? pin_of_first_cell(grid_, c11, {}) : 0;
  const auto add_row = [&](Index cell, int unknown, const FaceSpans& of_p, const FaceSpans& of_s) {
    rows.begin_row();
    rows.add(rows.row_of(cell), unknown == 0 && !diagonal_p.empty() ? diagonal_p[std::size_t(cell)] : 0.0);
    if (unknown == 0 && cell == grid_.index(0, 0)) rows.add(rows.row_of(cell), pin);
    rows.add(rows.row_of(cell) + 1, unknown == 0 ? 0.0 : c);
    for (int d = 0; d < grid_.dimensions; ++d) {
      const auto a = std::size_t(d);
      const double w = 1 / (grid_.spacing[a] * grid_.spacing[a]);
      for (const int side : {-1, 1}) {
        const auto face = std::size_t(cell + (side < 0 ? 0 : grid_.stride(d)));
        couple(cell, cell + side * grid_.stride(d), w * of_p[a][face], w * of_s[a][face]);
      }
    }
    rows.end_row();
  };
  for_each_row(grid_, [&](Index begin, Index end) {
    for (Index cell = begin; cell < end; ++cell) {
      add_row(cell, 0, c11, c12);
      add_row(cell, 1, c21, c22);
    }
  });
  rows.assemble(2, false);
  const bool fine = HYPRE_GetError() == 0;
  HYPRE_ClearAllErrors();
  return on_all_ranks(grid_, fine);
}

void BlockSolver::apply(const Field& r1, const Field& r2, Field& p, Field& s, int cycles) {
  std::vector<double>& packed = hypre_->packed;
  double* to = packed.data();
  for_each_row(grid_, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      *to++ = r1[c];
      *to++ = r2[c];
    }
  });
  hypre_->rows.set_right(packed);
  hypre_->rows.cycles(cycles);
  HYPRE_ClearAllErrors();
  hypre_->rows.get_solution(packed);
  const double* from = packed.data();
  for_each_row(grid_, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      p[c] = *from++;
      s[c] = *from++;
    }
  });
}

}  // namespace polybed::core
