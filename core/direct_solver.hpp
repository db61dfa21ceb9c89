// The same elliptic equations solved directly: reference for the tests, and rescue where multigrid fails.
#pragma once

#include <array>
#include <span>

#include "core/field.hpp"

namespace polybed::core {

/// Norm of source - (shift p - div(B grad p)) over the norm of the source, both over the owned cells; 0 if
/// both vanish. Arguments as in PoissonSolver::solve. Sets the ghost cells of p beside the owned ones.
[[nodiscard]] double relative_residual(const Grid& grid, const std::array<std::span<const double>, 3>& coefficient,
                                       std::span<const double> shift, const Field& source, Field& p);

/// Whether the equation leaves a constant open: no shift, and no coefficient on any boundary face.
[[nodiscard]] bool leaves_constant_open(const Grid& grid, const std::array<std::span<const double>, 3>& coefficient,
                                        std::span<const double> shift);

/// Solves by a sparse factorisation (Eigen's LDLT); false if the matrix is not positive definite. Where a
/// constant is left open the first cell is pinned to 0.
bool solve_directly(const Grid& grid, const std::array<std::span<const double>, 3>& coefficient,
                    std::span<const double> shift, const Field& source, Field& p);

}  // namespace polybed::core
