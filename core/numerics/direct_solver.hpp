// Direct solution of the same elliptic equations: reference for the tests, and fallback where multigrid fails.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/numerics/halo.hpp"

namespace polybed::core {

/// Norm of source - (shift p - div(B grad p)) over the norm of the source, both over the column; 0 if both vanish.
/// Arguments as in PoissonSolver::solve. Sets the ghost cells of p next to the owned ones. Collective.
[[nodiscard]] double relative_residual(const Grid& grid, const Halo& halo,
                                       const std::array<std::span<const double>, 3>& coefficient,
                                       std::span<const double> shift, const Field& source, Field& p);

/// Whether the solution is unique only up to a constant: no shift, and no coefficient on any boundary face. Collective.
[[nodiscard]] bool leaves_constant_open(const Grid& grid, const std::array<std::span<const double>, 3>& coefficient,
                                        std::span<const double> shift);

/// A cell of this block that fixes an open constant, and the number added to its diagonal.
struct Pin {
  Index cell;
  double diagonal;
};

/// An open constant makes multigrid's coarsest matrix singular. Adding a diagonal of the usual size in one cell makes
/// the unknown vanish there and changes nothing else, as sources sum to zero. The cell is the column's first, or in the
/// middle of the bottom where a round wall closes corners. Nothing without an open constant and on the other ranks.
/// Collective.
[[nodiscard]] std::optional<Pin> pin_of(const Grid& grid, const std::array<std::span<const double>, 3>& coefficient,
                                        std::span<const double> shift);

/// Solves with a sparse factorisation (Eigen's LDLT); false if the matrix is not positive definite. The cell of
/// pin_of() has 0 if a constant is open. For a column on one rank.
bool solve_directly(const Grid& grid, const std::array<std::span<const double>, 3>& coefficient,
                    std::span<const double> shift, const Field& source, Field& p);

}  // namespace polybed::core
