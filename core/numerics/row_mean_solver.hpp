// The pressure's equation of a column with few cells across: conjugate gradients, preconditioned by the same equation
// with its coefficients averaged over each horizontal row, which is solved exactly. In a liquid bed coefficients differ
// by a tenth along a row, and one or two iterations do.
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <span>
#include <vector>

#include "core/numerics/halo.hpp"
#include "core/numerics/linear_solver.hpp"
#include "core/numerics/section_modes.hpp"

namespace polybed::core {

class RowMeanSolver {
 public:
  /// Whether a whole column is one that this serves: with at most 64 cells across each way, and where a wall cuts cells
  /// with a section that has modes.
  [[nodiscard]] static bool serves(const Grid& grid);
  explicit RowMeanSolver(const Grid& grid);

  /// Arguments as in PoissonSolver::solve, shift with whatever pins an open constant. Returns the iterations; nothing,
  /// with p as given, where coefficients along a row differ too much. Whether the iterations were enough is for the
  /// caller to see from the residual. What it returns depends on its arguments alone.
  std::optional<int> solve(const FaceSpans& coefficient, std::span<const double> shift, const Field& source, Field& p,
                           double tolerance);

 private:
  using Matrix = SectionModes::Matrix;

  /// The waves that fit across an axis of the grid, which the second difference there only scales; of rings what takes
  /// their place.
  struct Modes {
    Matrix waves;              ///< a column each, of length 1; of rings by volume
    std::vector<double> rate;  ///< times minus the second difference of spacing 1
  };

  [[nodiscard]] static Modes modes_of(const Grid& grid, int axis);
  [[nodiscard]] static Modes modes_of_rings(const Grid& grid);
  [[nodiscard]] bool average(const FaceSpans& coefficient, std::span<const double> shift);
  void factorise();
  void precondition(const Field& r, Field& z);
  void sweep();
  void apply(const FaceSpans& coefficient, std::span<const double> shift, Field& p, Field& out);

  Grid grid_;
  Halo halo_;
  std::optional<SectionModes> section_;  ///< where a wall cuts cells, in place of waves both ways
  Modes x_, z_;
  std::vector<double> across_[2], up_, diagonal_;  ///< means over rows: along axes 0 and 2, 1 (faces), and of the shift
  std::vector<double> factor_;                     ///< 1/pivot of each mode: [layer][row][mode]
  Matrix values_, turned_;                         ///< rows of cells, or of modes: [layer * height + row][across]
  Field residual_, direction_, image_, preconditioned_;
};

}  // namespace polybed::core
