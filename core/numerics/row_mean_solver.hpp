// The pressure equation of a column with few cells across: conjugate gradients, preconditioned by the same equation
// with coefficients averaged over each horizontal row, which is solved exactly. In a liquid bed coefficients differ by
// a tenth along a row, and one or two iterations suffice. In a tube with ports the preconditioner is that of the tube
// without them and, around the ports, the equation itself.
#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/numerics/halo.hpp"
#include "core/numerics/linear_solver.hpp"
#include "core/numerics/port_patch.hpp"
#include "core/numerics/section_modes.hpp"

namespace polybed::core {

class RowMeanSolver {
 public:
  /// Whether it suits a whole column: at most 64 cells across each way and, where a wall cuts cells, a cross-section
  /// with modes.
  [[nodiscard]] static bool serves(const Grid& grid);
  explicit RowMeanSolver(const Grid& grid);

  /// Arguments as in PoissonSolver::solve; shift includes the diagonal that fixes an open constant. Returns the
  /// iterations, or nothing and p unchanged if coefficients along a row differ too much. The caller checks the residual
  /// for convergence. The result depends on the arguments alone.
  std::optional<int> solve(const FaceSpans& coefficient, std::span<const double> shift, const Field& source, Field& p,
                           double tolerance);

 private:
  using Matrix = SectionModes::Matrix;

  /// The waves that fit across an axis of the grid: eigenvectors of its second difference. Rings have their own modes.
  struct Modes {
    Matrix waves;              ///< one per column, of length 1; rings: by volume
    std::vector<double> rate;  ///< eigenvalues of minus the second difference with spacing 1
  };

  [[nodiscard]] static Modes modes_of(const Grid& grid, int axis);
  [[nodiscard]] static Modes modes_of_rings(const Grid& grid);
  [[nodiscard]] bool average(const FaceSpans& coefficient, std::span<const double> shift);
  [[nodiscard]] double open_sides(const FaceSpans& coefficient, int row) const;
  void factorise();
  void precondition(const FaceSpans& coefficient, Field& r, Field& z);
  void join_ends();
  void sweep();
  void sweep_rows();
  void apply(const FaceSpans& coefficient, std::span<const double> shift, Field& p, Field& out);

  Grid grid_;
  Halo halo_;
  std::optional<SectionModes> section_;  ///< where a wall cuts cells, replaces waves both ways
  std::unique_ptr<PortPatch> ports_;     ///< where modes are of the column without its ports
  Modes x_, z_;
  std::vector<double> across_[2], up_, diagonal_;  ///< row means: along axes 0 and 2, 1 (faces), and of the shift
  std::vector<double> factor_;                     ///< 1/pivot of each mode: [layer][row][mode]
  double joined_ = 0;                              ///< mean coefficient between top and bottom where they are joined
  std::vector<double> around_;                     ///< then c/(1 + c w^T z) of each mode
  Matrix ends_;                                    ///< and z, like values_
  Matrix values_, turned_;                         ///< rows of cells, or of modes: [layer * height + row][across]
  Field residual_, direction_, image_, preconditioned_;
};

}  // namespace polybed::core
