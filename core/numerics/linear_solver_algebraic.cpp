#include "core/numerics/linear_solver_algebraic.hpp"

#include <vector>

#include "core/numerics/hypre_rows.hpp"

namespace polybed::core {

namespace {

constexpr int most_algebraic_iterations = 200;

/// The same rows as the structured matrix has, cell by cell.
void fill(const Grid& grid, const FaceSpans& coefficient, std::span<const double> shift, HypreRows& rows) {
  rows.begin();
  for_each_row(grid, [&](Index begin, Index end) {
    for (Index cell = begin; cell < end; ++cell) {
      rows.begin_row();
      rows.add(rows.row_of(cell), shift.empty() ? 0.0 : shift[std::size_t(cell)]);
      for (int d = 0; d < grid.dimensions; ++d) {
        const auto a = std::size_t(d);
        for (const int side : {-1, 1}) {
          const double b = coefficient[a][std::size_t(cell + (side < 0 ? 0 : grid.stride(d)))];
          const double value = b / (grid.spacing[a] * grid.spacing[a]);
          rows.add(rows.row_of(cell), value);
          const HYPRE_Int beyond = rows.row_of(cell + side * grid.stride(d));
          if (beyond >= 0) rows.add(beyond, -value);
        }
      }
      rows.end_row();
    }
  });
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
  HypreRows rows(grid, 1);
  fill(grid, coefficient, shift, rows);
  std::vector<double> solution = packed(grid, p);
  rows.set_right(packed(grid, source));
  rows.set_solution(solution);
  rows.assemble(1, true);
  const int iterations = rows.conjugate_gradients(tolerance, most_algebraic_iterations);
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
