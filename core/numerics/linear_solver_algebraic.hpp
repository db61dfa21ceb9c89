// The pressure's equation by algebraic multigrid, where the structured one is slow or fails: cells much longer than
// wide.
#pragma once

#include "core/numerics/linear_solver.hpp"

namespace polybed::core {

/// Conjugate gradients with BoomerAMG. Arguments as in PoissonSolver::solve; p is the first guess, then the solution.
/// Returns the iterations; whether they were enough is for the caller to see from the residual.
int solve_algebraically(const Grid& grid, const FaceSpans& coefficient, std::span<const double> shift,
                        const Field& source, Field& p, double tolerance);

}  // namespace polybed::core
