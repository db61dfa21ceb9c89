#include "core/numerics/linear_solver_algebraic.hpp"

#include <algorithm>

#include "core/numerics/hypre_rows.hpp"
#include "core/numerics/ranks.hpp"

namespace polybed::core {

namespace {

constexpr int most_algebraic_iterations = 200;

/// Fills in the same rows as in the structured matrix, cell by cell.
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

void pack(const Grid& grid, const Field& field, std::vector<double>& values) {
  values.resize(grid.cell_count());
  double* to = values.data();
  for_each_row(grid, [&](Index begin, Index end) { to = std::copy(field.begin() + begin, field.begin() + end, to); });
}

void unpack(const Grid& grid, const std::vector<double>& values, Field& field) {
  const double* from = values.data();
  for_each_row(grid, [&](Index begin, Index end) {
    std::copy(from, from + (end - begin), field.begin() + begin);
    from += end - begin;
  });
}

}  // namespace

int solve_algebraically(const Grid& grid, const FaceSpans& coefficient, std::span<const double> shift,
                        const Field& source, Field& p, double tolerance) {
  HypreRows rows(grid);
  fill(grid, coefficient, shift, rows);
  std::vector<double> solution;
  pack(grid, source, solution);
  rows.set_right(solution);
  pack(grid, p, solution);
  rows.set_solution(solution);
  rows.assemble();
  const int iterations = rows.conjugate_gradients(tolerance, most_algebraic_iterations);
  HYPRE_ClearAllErrors();
  rows.get_solution(solution);
  unpack(grid, solution, p);
  return iterations;
}

AlgebraicCycles::AlgebraicCycles(const Grid& grid) : grid_(grid), rows_(std::make_unique<HypreRows>(grid)) {}
AlgebraicCycles::~AlgebraicCycles() = default;

bool AlgebraicCycles::setup(const FaceSpans& coefficient, std::span<const double> shift) {
  fill(grid_, coefficient, shift, *rows_);
  rows_->assemble();
  const bool fine = HYPRE_GetError() == 0;
  HYPRE_ClearAllErrors();
  return on_all_ranks(grid_, fine);
}

void AlgebraicCycles::apply(const Field& source, Field& p, int cycles) {
  pack(grid_, source, packed_);
  rows_->set_right(packed_);
  rows_->cycles(cycles);
  HYPRE_ClearAllErrors();
  rows_->get_solution(packed_);
  unpack(grid_, packed_, p);
}

}  // namespace polybed::core
