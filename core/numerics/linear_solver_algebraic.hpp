// Algebraic multigrid for the pressure equation, where the structured one is slow or fails: cells much longer than
// wide.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/numerics/linear_solver.hpp"

namespace polybed::core {

/// Conjugate gradients with BoomerAMG. Arguments as in PoissonSolver::solve; p is the first guess, then the solution.
/// Returns the iterations; the caller checks the residual for convergence.
int solve_algebraically(const Grid& grid, const FaceSpans& coefficient, std::span<const double> shift,
                        const Field& source, Field& p, double tolerance);

class HypreRows;

/// A fixed number of BoomerAMG cycles for shift p - div(B grad p) = source, from p = 0. Collective.
class AlgebraicCycles {
 public:
  explicit AlgebraicCycles(const Grid& grid);
  ~AlgebraicCycles();
  AlgebraicCycles(const AlgebraicCycles&) = delete;
  AlgebraicCycles& operator=(const AlgebraicCycles&) = delete;

  /// False if the library refuses. Arguments as in PoissonSolver::solve.
  [[nodiscard]] bool setup(const FaceSpans& coefficient, std::span<const double> shift);
  void apply(const Field& source, Field& p, int cycles);

 private:
  Grid grid_;
  std::unique_ptr<HypreRows> rows_;
  std::vector<double> packed_;
};

}  // namespace polybed::core
