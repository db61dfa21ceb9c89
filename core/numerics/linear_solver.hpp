// Elliptic equations on the cells of a grid, with hypre: the pressure's Poisson equation, and the coupled system in the
// implicit integrator's preconditioner.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/numerics/halo.hpp"

namespace polybed::core {

/// Starts MPI, if it does not run yet, and hypre; once per process. Throws NumericsError.
void open_linear_solvers();

using FaceSpans = std::array<std::span<const double>, 3>;  ///< one padded array per active axis
[[nodiscard]] inline FaceSpans spans(const FaceField& b) { return {b[0], b[1], b[2]}; }

class RowMeanSolver;
class WholeColumn;

struct PoissonResult {
  bool converged = false;
  int iterations = 0;
  double residual = 0;      ///< true relative residual, recomputed after the solve
  const char* solver = "";  ///< the one that found the solution
};

/// Solves shift p - div(B grad p) = source on the cells of the column. Collective. The coefficient on a boundary face
/// sets the boundary condition: 0, no flux; else p = 0 in the centre of the ghost cell. Short rows with similar
/// coefficients are preconditioned by the row-mean solver, others by multigrid, whose hierarchy is reused while it
/// pays. The residual is recomputed. With short rows each rank solves the whole column and p has the same bits on any
/// number of ranks; otherwise it agrees within the tolerance.
/// is the same within the tolerance.
class PoissonSolver {
 public:
  explicit PoissonSolver(const Grid& grid);
  ~PoissonSolver();
  PoissonSolver(PoissonSolver&&) noexcept;
  PoissonSolver& operator=(PoissonSolver&&) noexcept;

  /// \param coefficient  B on faces, >= 0  \param shift  on cells, >= 0; can be empty
  /// \param source       on cells          \param p      the first guess, then the solution (owned cells)
  /// \param tolerance    of the residual relative to the source's norm
  PoissonResult solve(const FaceSpans& coefficient, std::span<const double> shift, const Field& source, Field& p,
                      double tolerance);
  /// Starts anew: further solves do not depend on earlier ones.
  void forget();

 private:
  struct Hypre;
  struct Whole;
  PoissonResult solve_whole(const FaceSpans& coefficient, std::span<const double> shift, const Field& source, Field& p,
                            double tolerance);

  Grid grid_;
  Halo halo_;
  std::unique_ptr<Whole> whole_;         ///< empty if ranks share the solution
  std::unique_ptr<RowMeanSolver> rows_;  ///< empty if it does not suit the column
  std::unique_ptr<Hypre> hypre_;         ///< empty until its first use
  Field balanced_;                       ///< the source without its mean, if a constant is open
  Field pinned_;                         ///< and the diagonal that fixes it
  std::vector<double> owned_;            ///< stored, so that its mean allocates nothing
};

/// An approximate inverse for two coupled unknowns per cell, with q = L s,
///   diagonal_p p - div(C11 grad p + C12 grad q) = r1,    c q/L - div(C21 grad p + C22 grad q) = r2.
/// The first equation is solved for C11 grad p on each face and put into the second, which leaves
///   c q/L - div((C22 - C21 C12/C11) grad q) = r2 - (C21/C11) r1,
/// exact where C21/C11 is even and diagonal_p 0. Both are symmetric, so each is
/// solved by a method for one unknown.
/// Boundary faces: p as in PoissonSolver with C11, q likewise with C12 and C22. Each rank solves for the whole column
/// where a direct method suits it.
class BlockSolver {
 public:
  explicit BlockSolver(const Grid& grid);
  ~BlockSolver();
  BlockSolver(BlockSolver&&) noexcept;
  BlockSolver& operator=(BlockSolver&&) noexcept;

  /// False if the library refuses. Collective.
  /// \param slope  L on cells, >= 0; q is 0 where it is 0  \param diagonal_p  on cells, >= 0; empty: 0
  [[nodiscard]] bool setup(const FaceSpans& c11, const FaceSpans& c12, const FaceSpans& c21, const FaceSpans& c22,
                           const Field& slope, const Field& diagonal_p, double c);
  /// p and q of the owned cells. Collective. \param cycles  for multigrid, if it is used
  void apply(const Field& r1, const Field& r2, Field& p, Field& q, int cycles);

 private:
  class Scalar;
  struct Whole;
  void set_beyond_ends(Field& q) const;

  Grid grid_;
  Halo halo_;
  std::unique_ptr<Whole> whole_;  ///< empty if ranks share the solution
  std::unique_ptr<Scalar> of_p_, of_q_;
  FaceField c12_;       ///< over the square of the distance
  FaceField rest_;      ///< C22 - C21 C12/C11
  Field share_;         ///< C21/C11, mean over the faces of a cell
  Field own_, pinned_;  ///< diagonals of q and of p
  Field source_;
};

}  // namespace polybed::core
