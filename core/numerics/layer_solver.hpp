// Exact solution of an elliptic equation on a column with few cells across: block elimination, layer by layer along the
// longest axis. The inverses of the eliminated layers are stored, so a solve is two products of a matrix and a vector
// per layer, whatever the coefficients are.
#pragma once

#include <span>
#include <vector>

#include "core/numerics/linear_solver.hpp"

namespace polybed::core {

class LayerSolver {
 public:
  /// Whether it suits a whole column: at most 64 cells in a layer.
  [[nodiscard]] static bool serves(const Grid& grid);
  explicit LayerSolver(const Grid& grid);

  /// Eliminates shift p - div(B grad p). The cost per layer grows with the third power of its cells.
  /// \param coefficient  as in PoissonSolver::solve  \param shift  on cells, >= 0; together they leave no open constant
  void setup(const FaceSpans& coefficient, std::span<const double> shift);
  /// p of the owned cells.
  void solve(const Field& source, Field& p);

 private:
  [[nodiscard]] double* inverse_of(std::size_t layer) { return inverse_.data() + layer * width_ * pitch_; }
  void add_layer(std::size_t layer, const FaceSpans& coefficient, std::span<const double> shift);

  Grid grid_;
  int axis_;                     ///< along which the layers are stacked
  std::size_t count_, width_;    ///< layers, cells in one
  std::size_t pitch_;            ///< width_ rounded up, for vectors; entries beyond are zero
  std::vector<Index> cell_;      ///< of the first layer
  std::vector<double> inverse_;  ///< [layer][cell][cell]
  std::vector<double> joint_;    ///< [layer][cell]: coefficient to the previous layer over the square of the distance
  std::vector<double> value_;    ///< [layer][cell]
  std::vector<double> work_;     ///< of one layer
};

}  // namespace polybed::core
