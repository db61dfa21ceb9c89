#include <vector>

#include "core/hypre_rows.hpp"
#include "core/linear_solver.hpp"

namespace polybed::core {

/// The two unknowns of a cell stand next to each other.
struct BlockSolver::Hypre {
  HypreRows rows;
  std::vector<double> packed;
  explicit Hypre(const Grid& grid) : rows(HYPRE_Int(2 * grid.cell_count())), packed(2 * grid.cell_count()) {}
};

BlockSolver::BlockSolver(const Grid& grid) : grid_(grid), hypre_(std::make_unique<Hypre>(grid)) {}
BlockSolver::~BlockSolver() = default;
BlockSolver::BlockSolver(BlockSolver&&) noexcept = default;
BlockSolver& BlockSolver::operator=(BlockSolver&&) noexcept = default;

bool BlockSolver::setup(const FaceSpans& c11, const FaceSpans& c12, const FaceSpans& c21, const FaceSpans& c22,
                        const Field& slope, double diagonal_p, double c) {
  HypreRows& rows = hypre_->rows;
  rows.begin();
  const auto cells = grid_.cells;
  const std::array<HYPRE_Int, 3> jump{1, cells[0], cells[0] * cells[1]};
  HYPRE_Int cell = 0;
  /// Flux of one unknown's equation through one face of cell (i, j, k): there, and to the cell beyond.
  const auto couple = [&](const std::array<int, 3>& here, int d, int side, double of_p, double of_s) {
    const auto a = std::size_t(d);
    std::array<int, 3> beyond = here;
    beyond[a] += side;
    HYPRE_Int other = cell + side * jump[a];
    rows.add(2 * cell, of_p);
    rows.add(2 * cell + 1, of_s * slope[std::size_t(grid_.index(here[0], here[1], here[2]))]);
    if (beyond[a] < 0 || beyond[a] >= cells[a]) {
      if (!grid_.periodic[a]) return;
      beyond[a] -= side * cells[a];
      other -= side * HYPRE_Int(cells[a]) * jump[a];
    }
    rows.add(2 * other, -of_p);
    rows.add(2 * other + 1, -of_s * slope[std::size_t(grid_.index(beyond[0], beyond[1], beyond[2]))]);
  };
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i, ++cell)
        for (int unknown = 0; unknown < 2; ++unknown) {
          const FaceSpans& of_p = unknown == 0 ? c11 : c21;
          const FaceSpans& of_s = unknown == 0 ? c12 : c22;
          rows.begin_row();
          rows.add(2 * cell, unknown == 0 ? diagonal_p : 0.0);
          rows.add(2 * cell + 1, unknown == 0 ? 0.0 : c);
          for (int d = 0; d < grid_.dimensions; ++d) {
            const auto a = std::size_t(d);
            const double w = 1 / (grid_.spacing[a] * grid_.spacing[a]);
            for (const int side : {-1, 1}) {
              const auto face = std::size_t(grid_.index(i, j, k) + (side < 0 ? 0 : grid_.stride(d)));
              couple({i, j, k}, d, side, w * of_p[a][face], w * of_s[a][face]);
            }
          }
          rows.end_row(2 * cell + unknown);
        }
  rows.assemble(2, false);
  const bool fine = HYPRE_GetError() == 0;
  HYPRE_ClearAllErrors();
  return fine;
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
