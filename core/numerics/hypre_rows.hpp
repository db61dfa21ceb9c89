// A matrix given row by row, with hypre's algebraic multigrid: the common part of its solvers.
#pragma once

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_parcsr_ls.h>

#include <span>
#include <vector>

#include "core/numerics/field.hpp"

namespace polybed::core {

/// Rows are filled in order, then assembled; vectors have the same length. Each rank fills the rows of its cells.
class HypreRows {
 public:
  explicit HypreRows(const Grid& grid);
  ~HypreRows();
  HypreRows(const HypreRows&) = delete;
  HypreRows& operator=(const HypreRows&) = delete;

  void begin();
  void begin_row() { first_ = value_.size(); }
  /// Adds to an entry of the present row. Across periodic sides of one or two cells both neighbours are the same cell.
  void add(HYPRE_Int column, double value);
  void end_row() { row_size_.push_back(HYPRE_Int(value_.size() - first_)); }

  /// Row of a cell (core/numerics/blocks.hpp), owned or next to an owned one; below 0 beyond the column's ends.
  [[nodiscard]] HYPRE_Int row_of(Index cell) const { return HYPRE_Int(numbers_[std::size_t(cell)]); }

  /// Assembles the matrix and the hierarchy of BoomerAMG: HMIS coarsening, extended+i interpolation.
  void assemble();

  /// Sets the right-hand side or the solution, in the order of the rows.
  void set_right(std::span<const double> values);
  void set_solution(std::span<const double> values);
  void get_solution(std::span<double> values);

  /// Runs a fixed number of cycles from a zero first guess.
  void cycles(int count);
  /// Conjugate gradients with one cycle as preconditioner, from the current solution; returns the iterations.
  int conjugate_gradients(double tolerance, int most_iterations);

 private:
  void clear();
  [[nodiscard]] HYPRE_ParCSRMatrix parcsr() const;

  MPI_Comm all_;
  HYPRE_Int rows_;
  Field numbers_;  ///< of the cells
  HYPRE_IJMatrix matrix_ = nullptr;
  HYPRE_IJVector right_ = nullptr, solution_ = nullptr;
  HYPRE_Solver multigrid_ = nullptr;
  std::vector<HYPRE_Int> row_, row_size_, column_;
  std::vector<double> value_;
  std::size_t first_ = 0;  ///< of the row that is being filled
};

}  // namespace polybed::core
