// Gathers the fields of a divided column on every rank, so that a serial direct solver can be used and its result does
// not depend on the division.
#pragma once

#include <span>
#include <vector>

#include "core/numerics/halo.hpp"

namespace polybed::core {

class WholeColumn {
 public:
  explicit WholeColumn(const Grid& block);

  /// The column as one block.
  [[nodiscard]] const Grid& grid() const { return grid_; }

  /// A field of this rank's block, and the column field that it is gathered into.
  struct Part {
    std::span<const double> block;  ///< owned cells, or owned faces of one axis
    Field* column;
    int faces_of = cells;  ///< the axis of the faces
    static constexpr int cells = -1;
  };
  /// Gathers all parts in one message. Collective.
  void gather(const std::vector<Part>& parts);
  /// Copies this rank's cells of a field of the column.
  void copy_cells(const Field& column, Field& block) const;

 private:
  Grid block_, grid_;
  std::vector<Grid> blocks_;  ///< of all ranks, in rank order
  Halo joined_;
  std::vector<double> here_, all_;  ///< stored, so that gathering allocates nothing
};

/// Adds the components of a face field, axis by axis.
void add_faces(const std::array<std::span<const double>, 3>& block, FaceField& column,
               std::vector<WholeColumn::Part>& parts);

}  // namespace polybed::core
