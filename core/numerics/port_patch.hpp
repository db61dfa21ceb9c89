// The cells of a round column around its ports, where the equation differs from that of the same column without ports.
#pragma once

#include <Eigen/Sparse>
#include <span>
#include <vector>

#include "core/numerics/linear_solver.hpp"

namespace polybed::core {

class PortPatch {
 public:
  /// The same column without ports in a curved wall; itself if it has none.
  [[nodiscard]] static Grid without_ports(const Grid& column);
  /// \param column  a whole cylinder with ports  \param plain  the same without
  PortPatch(const Grid& column, const Grid& plain);

  /// Factorises the equation shift p - div(B grad p) on the patch; false if it is not positive definite.
  [[nodiscard]] bool setup(const FaceSpans& coefficient, std::span<const double> shift);
  /// Sets p on the patch so that the equation is satisfied there, given p around it.
  /// \param source  empty: 0
  void fill(const FaceSpans& coefficient, std::span<const double> source, Field& p);
  /// Sets a field on the patch to 0, or to another.
  void clear(Field& field) const;
  void copy(const Field& from, Field& to) const;

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  /// Calls body(place in patch, axis, face, neighbour, its place or -1, 1/h^2) for all faces of the patch's cells.
  template <class Body>
  void for_each_face(Body&& body) const;

  Grid grid_;
  std::vector<Index> cell_;
  std::vector<int> place_;  ///< of each cell of the padded box, or -1
  Matrix matrix_;
  Eigen::SimplicialLDLT<Matrix> factor_;
  Eigen::VectorXd right_;
};

}  // namespace polybed::core
