// The modes of a cross-section that a round wall cuts out of equal cells, in place of the waves of a row of cells. A
// section is its own mirror image left and right, front and back. Modes are therefore even or odd each way, and each of
// the four kinds needs a quarter of the cells.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "core/numerics/field.hpp"

namespace polybed::core {

class SectionModes {
 public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// Whether a whole column is cut alike at every height, with at most 400 cells in a quarter of a layer: the cost of
  /// the setup grows with their third power.
  [[nodiscard]] static bool serves(const Grid& column);
  explicit SectionModes(const Grid& column);

  /// Eigenvalues in -sum over sides of alpha (p_next - p)/h^2 = rate theta p, 1/m2; one for each mode.
  [[nodiscard]] const std::vector<double>& rates() const { return rates_; }
  /// Transforms a field on cells to a row of modes for each height, and back. \param work  of the same size
  void to_modes(const Field& cells, Matrix& work, Matrix& modes) const;
  void to_cells(const Matrix& modes, Matrix& work, Field& cells) const;

 private:
  Grid grid_;
  Index half_x_, half_z_, quarter_;  ///< cells, including the middle ones
  std::array<Matrix, 4> modes_;      ///< even or odd along x, then along z; one per column
  std::array<Matrix, 4> turned_;     ///< and one per row
  std::vector<double> rates_;
};

}  // namespace polybed::core
