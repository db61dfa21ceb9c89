// Ghost values around a block: walls, distributor, outlet, joined sides, other ranks' cells.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/case/scene.hpp"
#include "core/numerics/halo.hpp"
#include "fluid/open_face.hpp"

namespace polybed::fluid {

/// Fluid flow through the bottom and the top: none from outside, also where they are joined; a given velocity below and
/// a given pressure above; or given velocities at both.
enum class Ends { walls, outlet, given };
[[nodiscard]] inline Ends ends_of(const core::Scene& scene) {
  if (scene.column.closed || scene.flows_around()) return Ends::walls;
  const bool lid = scene.column.outlet == core::Outlet::lid;
  return scene.inlet.at == core::ColumnEnd::top || lid ? Ends::given : Ends::outlet;
}

/// The sides with inflow or outflow of fluid or solids through parts of them.
[[nodiscard]] std::vector<core::ColumnFace> crossed_sides(const core::Scene& scene);

/// Boundary condition of a velocity along a wall.
enum class WallSlip { no_slip, free_slip };

/// A field that needs ghosts. `joined`: only ghosts owned by other cells, across joined sides or on other ranks.
struct Ghosts {
  enum class Kind { cells, velocity, joined } kind;
  core::Field* field;
  int component = -1;  ///< of a velocity
  WallSlip slip = WallSlip::no_slip;
};

/// The column's sides: faces with a fixed velocity, and ghosts computed from the inside.
class Boundaries {
 public:
  Boundaries() = default;
  /// open: solids can leave through the outlet.
  Boundaries(const core::Grid& grid, Ends ends, bool open = false, std::vector<core::ColumnFace> crossed = {},
             std::vector<OpenFace> open_faces = {})
      : grid_(grid),
        halo_(grid),
        ends_(ends),
        open_(open && ends == Ends::outlet),
        crossed_(std::move(crossed)),
        open_faces_(std::move(open_faces)) {}

  [[nodiscard]] bool closed() const { return ends_ == Ends::walls; }
  /// Whether the pressure is given at the top, so that the outflow is free.
  [[nodiscard]] bool has_outlet() const { return ends_ == Ends::outlet; }
  [[nodiscard]] bool open() const { return open_; }
  [[nodiscard]] const std::vector<core::ColumnFace>& crossed() const { return crossed_; }
  /// Faces in the sides with a pressure given outside.
  [[nodiscard]] const std::vector<OpenFace>& open_faces() const { return open_faces_; }

  /// Whether this block has a wall for the solids at the low (0) or high (1) end of an axis: at all ends of the column,
  /// including the distributor, except the top of an open one.
  [[nodiscard]] bool stops_solids(int axis, int side) const {
    return grid_.ends(axis, side) && (axis != 1 || side == 0 || !has_outlet());
  }

  /// Restricts the solids to rows of the column below this one: their equations are solved only there, and no solids
  /// cross its low faces. Initially they can be anywhere.
  void hold_solids_above(int row) { solids_rows_ = row - grid_.before[1]; }
  /// The part of a box of this block's cells or faces where the solids' equations are solved.
  [[nodiscard]] core::Box with_solids(core::Box box) const {
    box.hi[1] = std::max(box.lo[1], std::min(box.hi[1], solids_rows_));
    return box;
  }
  /// Owned cells, likewise.
  [[nodiscard]] core::Box solids_cells() const { return with_solids(core::owned_cells(grid_)); }

  /// Fills ghosts of several fields, in one message to each neighbouring rank and axis. Collective, like the others.
  void fill(std::span<const Ghosts> wanted) const;

  /// Fills ghosts of cell fields: values owned by other cells, and the nearest owned value at the column's ends.
  void fill_cells(core::Field& field) const;
  void fill_cells(std::span<core::Field> fields) const;

  /// Fills ghosts of a velocity on faces. Along walls and the distributor the tangential components are mirrored
  /// (no_slip) or copied (free_slip). At the outlet everything is copied; normal components are mirrored at walls.
  void fill_velocity(core::FaceField& velocity, WallSlip slip) const;

  /// Fetches the values on the high faces of a block's last cells, which belong to the next block or, across joined
  /// sides, to the first one.
  void join(core::Field& on_faces, int axis) const;
  void join(core::FaceField& faces) const {
    for (int axis = 0; axis < grid_.dimensions; ++axis) join(faces[std::size_t(axis)], axis);
  }
  /// The same for two fields in one message.
  void join(core::FaceField& faces, core::FaceField& others) const;

  /// The faces of an axis with variable velocity: all except those on walls and on the distributor. The outlet's faces
  /// are included for the fluid and, if it is open and the solids are not held there, for solids.
  [[nodiscard]] core::Box moving_faces(int axis, bool of_fluid) const {
    core::Box box = core::interior_faces(grid_, axis);
    if ((of_fluid || open_) && axis == 1 && has_outlet() && grid_.ends(1, 1)) ++box.hi[1];
    return of_fluid ? box : with_solids(box);
  }

  /// The moving faces of an axis next to owned cells, including those of the next block or across joined sides.
  [[nodiscard]] core::Box moving_faces_of_cells(int axis, bool of_fluid) const {
    core::Box box = moving_faces(axis, of_fluid);
    if (axis == 1 && box.hi[1] < grid_.cells[1]) return box;  // below the rows that are held
    if (!grid_.ends(axis, 1)) ++box.hi[std::size_t(axis)];
    return of_fluid ? box : with_solids(box);
  }

 private:
  void fill_walls(const Ghosts& wanted, int axis) const;
  void copy_outward(core::Field& u) const;
  [[nodiscard]] bool begins_at_axis(int axis) const;
  void fill_beyond(core::Field& field, int axis, double sign_low, double sign_high, bool on_faces) const;

  core::Grid grid_;
  core::Halo halo_;
  mutable std::vector<core::Field*> exchanged_;  ///< stored, so that filling allocates nothing
  mutable std::vector<Ghosts> wanted_;
  Ends ends_ = Ends::outlet;
  bool open_ = false;
  std::vector<core::ColumnFace> crossed_;
  std::vector<OpenFace> open_faces_;
  int solids_rows_ = std::numeric_limits<int>::max();  ///< in this block, counted from its first row
};

/// Calls body(begin, end) for the rows of faces of an axis at the column's low (side 0) or high end, if this block
/// reaches it.
template <class Body>
void for_each_boundary_row(const core::Grid& grid, int axis, int side, Body&& body) {
  if (!grid.ends(axis, side)) return;
  core::Box box = core::owned_cells(grid);
  const auto a = std::size_t(axis);
  box.lo[a] = side == 0 ? 0 : grid.cells[a];
  box.hi[a] = box.lo[a] + 1;
  core::for_each_row(grid, box, body);
}

/// Fills ghosts of the velocity along the axis of a side beyond one of its faces: the flow continues unchanged.
inline void extend_beyond(const core::Grid& grid, core::ColumnFace at, core::Index face, core::Field& velocity) {
  const core::Index s = grid.stride(axis_of(at));
  for (int layer = 1; layer <= core::Grid::halo - side_of(at); ++layer)
    velocity[std::size_t(side_of(at) == 0 ? face - layer * s : face + layer * s)] = velocity[std::size_t(face)];
}

}  // namespace polybed::fluid
