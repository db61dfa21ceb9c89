#include "core/linear_solver_algebraic.hpp"

#include <vector>

#include "core/hypre_rows.hpp"

namespace polybed::core {

namespace {

constexpr int most_iterations = 200;

/// The same rows as the structured matrix has, cell by cell.
void fill(const Grid& grid, const FaceSpans& coefficient, std::span<const double> shift, HypreRows& rows) {
  const auto cells = grid.cells;
  const std::array<HYPRE_Int, 3> jump{1, cells[0], cells[0] * cells[1]};
  HYPRE_Int cell = 0;
  rows.begin();
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i, ++cell) {
        const Index at = grid.index(i, j, k);
        const std::array<int, 3> here{i, j, k};
        rows.begin_row();
        rows.add(cell, shift.empty() ? 0.0 : shift[std::size_t(at)]);
        for (int d = 0; d < grid.dimensions; ++d) {
          const auto a = std::size_t(d);
          for (const int side : {-1, 1}) {
            const double b = coefficient[a][std::size_t(at + (side < 0 ? 0 : grid.stride(d)))];
            const double value = b / (grid.spacing[a] * grid.spacing[a]);
            rows.add(cell, value);
            const bool inside = here[a] + side >= 0 && here[a] + side < cells[a];
            if (!inside && !grid.periodic[a]) continue;
            rows.add(cell + side * (inside ? 1 : 1 - cells[a]) * jump[a], -value);
          }
        }
        rows.end_row(cell);
      }
}

std::vector<double> packed(const Grid& grid, const Field& field) {
  std::vector<double> values;
  values.reserve(grid.cell_count());
  for_each_row(
      grid, [&](Index begin, Index end) { values.insert(values.end(), field.begin() + begin, field.begin() + end); });
  return values;
}

}  // namespace

int solve_algebraically(const Grid& grid, const FaceSpans& coefficient, std::span<const double> shift,
                        const Field& source, Field& p, double tolerance) {
  HypreRows rows(HYPRE_Int(grid.cell_count()));
  fill(grid, coefficient, shift, rows);
  std::vector<double> solution = packed(grid, p);
  rows.set_right(packed(grid, source));
  rows.set_solution(solution);
  rows.assemble(1, true);
  const int iterations = rows.conjugate_gradients(tolerance, most_iterations);
  HYPRE_ClearAllErrors();
  rows.get_solution(solution);
  const double* from = solution.data();
  for_each_row(grid, [&](Index begin, Index end) {
    std::copy(from, from + (end - begin), p.begin() + begin);
    from += end - begin;
  });
  return iterations;
}

}  // namespace polybed::core
