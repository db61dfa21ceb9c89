// Values of fields in the ghost entries around the column: walls, distributor, outlet, periodic sides.
#pragma once

#include "core/field.hpp"

namespace polybed::fluid {

/// What a velocity does along a wall.
enum class WallSlip { no_slip, free_slip };

/// The column's sides: which faces are held, and how ghosts follow from the inside.
class Boundaries {
 public:
  Boundaries() = default;
  /// closed: no inlet and no outlet, walls all round; open: the outlet lets solids out.
  Boundaries(const core::Grid& grid, bool closed, bool open = false)
      : grid_(grid), closed_(closed), open_(open && !closed) {}

  [[nodiscard]] bool closed() const { return closed_; }
  [[nodiscard]] bool open() const { return open_; }

  /// Ghosts of a cell field: images across periodic sides, else the nearest owned value.
  void fill_cells(core::Field& field) const;

  /// Ghosts of a velocity on faces. Along walls and the distributor the tangential components are mirrored
  /// (no_slip) or copied (free_slip); at the outlet everything is copied; normal components mirror at walls.
  void fill_velocity(core::FaceField& velocity, WallSlip slip) const;

  /// Across periodic sides the last face of an axis is the first one: makes what stands on faces say so.
  void join(core::Field& on_faces, int axis) const {
    if (grid_.periodic[std::size_t(axis)]) copy_periodic(on_faces, axis);
  }
  void join(core::FaceField& faces) const {
    for (int axis = 0; axis < grid_.dimensions; ++axis) join(faces[std::size_t(axis)], axis);
  }

  /// The faces of an axis whose velocity moves: all but those on walls and on the distributor. The outlet's
  /// faces move for the fluid, and for solids if it is open.
  [[nodiscard]] core::Box moving_faces(int axis, bool of_fluid) const {
    core::Box box = core::interior_faces(grid_, axis);
    if ((of_fluid || open_) && axis == 1 && !closed_ && !grid_.periodic[1]) ++box.hi[1];
    return box;
  }

  /// Sets all boundary faces of a face field (sides, bottom, top) to a value, except across periodic sides.
  void hold_boundary(core::FaceField& faces, double value) const;

 private:
  void copy_periodic(core::Field& field, int axis) const;
  void copy_outward(core::Field& u) const;
  void fill_beyond(core::Field& field, int axis, double sign_low, double sign_high, bool on_faces) const;

  core::Grid grid_;
  bool closed_ = false, open_ = false;
};

/// Calls body(begin, end, stride) for the rows of boundary faces of an axis at its low (side 0) or high end.
template <class Body>
void for_each_boundary_row(const core::Grid& grid, int axis, int side, Body&& body) {
  core::Box box = core::owned_cells(grid);
  const auto a = std::size_t(axis);
  box.lo[a] = side == 0 ? 0 : grid.cells[a];
  box.hi[a] = box.lo[a] + 1;
  core::for_each_row(grid, box, body);
}

}  // namespace polybed::fluid
