// Ghost entries owned by other cells of the column: on a neighbouring rank, or across joined sides.
#pragma once

#include <span>
#include <vector>

#include "core/numerics/field.hpp"

namespace polybed::core {

/// Calls body(begin, end) for the rows of one layer of the padded box across an axis. The layer includes the ghosts of
/// the other axes, so that treating the axes in turn fills the corners too.
template <class Body>
void for_each_layer_row(const Grid& grid, int axis, int layer, Body&& body) {
  Box box{{-grid.ghosts(0), -grid.ghosts(1), -grid.ghosts(2)}, {}};
  for (std::size_t d = 0; d < 3; ++d) box.hi[d] = grid.cells[d] + grid.ghosts(int(d));
  box.lo[std::size_t(axis)] = layer;
  box.hi[std::size_t(axis)] = layer + 1;
  for_each_row(grid, box, body);
}

class Halo {
 public:
  Halo() = default;
  explicit Halo(const Grid& grid) : grid_(grid) {}

  /// Fills the ghost layers of all the fields across an axis, on cells or on faces of any axis, with one message to
  /// each neighbour. The ghosts beyond the column's ends stay unchanged. Collective.
  void exchange(std::span<Field* const> fields, int axis) const;

 private:
  void copy_images(Field& field, int axis) const;
  void send_and_receive(std::span<Field* const> fields, int axis) const;

  Grid grid_;
  mutable std::vector<double> outgoing_[2], incoming_[2];  ///< kept, so that an exchange allocates nothing
};

}  // namespace polybed::core
