// An elliptic equation on a column with few cells across, solved exactly: block elimination, layer by layer along the
// longest axis. The inverse of what elimination makes of each layer is kept, so that a solve is two products of a
// matrix and a vector for each layer, whatever the coefficients are.
#pragma once

#include <span>
#include <vector>

#include "core/numerics/linear_solver.hpp"

namespace polybed::core {

class LayerSolver {
 public:
  /// Whether a whole column is one that this serves: with at most 64 cells in a layer.
  [[nodiscard]] static bool serves(const Grid& grid);
  explicit LayerSolver(const Grid& grid);

  /// Eliminates shift p - div(B grad p). Costs the third power of the cells in a layer for each layer.
  /// \param coefficient  as for PoissonSolver::solve  \param shift  on cells, >= 0; together they leave no constant open
  void setup(const FaceSpans& coefficient, std::span<const double> shift);
  /// p of the owned cells.
  void solve(const Field& source, Field& p);

 private:
  [[nodiscard]] double* inverse_of(std::size_t layer) { return inverse_.data() + layer * width_ * pitch_; }
  void add_layer(std::size_t layer, const FaceSpans& coefficient, std::span<const double> shift);

  Grid grid_;
  int axis_;                     ///< along which layers follow each other
  std::size_t count_, width_;    ///< layers, cells in one
  std::size_t pitch_;            ///< width_ rounded up, for vectors; entries beyond are zero
  std::vector<Index> cell_;      ///< of the first layer
  std::vector<double> inverse_;  ///< [layer][cell][cell]
  std::vector<double> joint_;    ///< [layer][cell]: coefficient to the layer before over the square of the distance
  std::vector<double> value_;    ///< [layer][cell]
  std::vector<double> work_;     ///< of one layer
};

}  // namespace polybed::core
