#include "fluid/boundaries.hpp"

#include <algorithm>

namespace polybed::fluid {

using core::Box;
using core::Field;
using core::Index;

namespace {

/// Rows of one layer of the padded box across an axis, the ghosts of the other axes included, so that corners
/// are filled too when the axes are treated in turn.
template <class Body>
void for_each_layer_row(const core::Grid& grid, int axis, int layer, Body&& body) {
  Box box{{-grid.ghosts(0), -grid.ghosts(1), -grid.ghosts(2)}, {}};
  for (std::size_t d = 0; d < 3; ++d) box.hi[d] = grid.cells[d] + grid.ghosts(int(d));
  box.lo[std::size_t(axis)] = layer;
  box.hi[std::size_t(axis)] = layer + 1;
  core::for_each_row(grid, box, body);
}

}  // namespace

void Boundaries::copy_periodic(Field& field, int axis) const {
  const int n = grid_.cells[std::size_t(axis)];
  const Index period = n * grid_.stride(axis);
  for (int layer = 0; layer < grid_.ghosts(axis); ++layer) {
    for_each_layer_row(grid_, axis, n + layer, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) field[std::size_t(c)] = field[std::size_t(c - period)];
    });
    for_each_layer_row(grid_, axis, -1 - layer, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) field[std::size_t(c)] = field[std::size_t(c + period)];
    });
  }
}

/// Ghost layers as sign times the mirror image: about the boundary face for entries on cells (or faces of
/// another axis), about the boundary face itself for entries on faces of this axis.
void Boundaries::fill_beyond(Field& field, int axis, double sign_low, double sign_high, bool on_faces) const {
  const int n = grid_.cells[std::size_t(axis)];
  const Index s = grid_.stride(axis);
  for (int layer = 1; layer <= grid_.ghosts(axis); ++layer) {
    const int low = -layer, low_mirror = on_faces ? layer : layer - 1;
    for_each_layer_row(grid_, axis, low, [&](Index begin, Index end) {
      const Index shift = (std::min(low_mirror, n - 1) - low) * s;
      for (Index c = begin; c < end; ++c) field[std::size_t(c)] = sign_low * field[std::size_t(c + shift)];
    });
    const int high = on_faces ? n + layer : n - 1 + layer, high_mirror = on_faces ? n - layer : n - layer;
    if (high >= n + grid_.ghosts(axis)) continue;
    for_each_layer_row(grid_, axis, high, [&](Index begin, Index end) {
      const Index shift = (high - std::max(high_mirror, 0)) * s;
      for (Index c = begin; c < end; ++c) field[std::size_t(c)] = sign_high * field[std::size_t(c - shift)];
    });
  }
}

/// Ends of the vertical velocity: what leaves or enters goes on as it is beyond the distributor and the outlet.
void Boundaries::copy_outward(Field& u) const {
  const Index s = grid_.stride(1);
  const int n = grid_.cells[1];
  for_each_layer_row(grid_, 1, n + 1, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) u[std::size_t(c)] = u[std::size_t(c - s)];
  });
  for (int layer = -1; layer >= -grid_.ghosts(1); --layer)
    for_each_layer_row(grid_, 1, layer, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) u[std::size_t(c)] = u[std::size_t(c + s)];
    });
}

void Boundaries::fill_cells(Field& field) const {
  for (int axis = 0; axis < grid_.dimensions; ++axis)
    if (grid_.periodic[std::size_t(axis)])
      copy_periodic(field, axis);
    else
      fill_beyond(field, axis, 1, 1, false);
}

void Boundaries::fill_velocity(core::FaceField& velocity, WallSlip slip) const {
  const double along_wall = slip == WallSlip::no_slip ? -1 : 1;
  for (int component = 0; component < grid_.dimensions; ++component) {
    Field& u = velocity[std::size_t(component)];
    for (int axis = 0; axis < grid_.dimensions; ++axis) {
      const bool open_top = axis == 1 && !closed_;
      if (grid_.periodic[std::size_t(axis)])
        copy_periodic(u, axis);
      else if (axis == component)
        fill_beyond(u, axis, -1, -1, true);
      else
        fill_beyond(u, axis, along_wall, open_top ? 1 : along_wall, false);
    }
    if (component == 1 && !closed_ && !grid_.periodic[1]) copy_outward(u);
  }
}

void Boundaries::hold_boundary(core::FaceField& faces, double value) const {
  for (int axis = 0; axis < grid_.dimensions; ++axis) {
    if (grid_.periodic[std::size_t(axis)]) continue;
    for (int side = 0; side < 2; ++side)
      for_each_boundary_row(grid_, axis, side, [&](Index begin, Index end) {
        std::fill(faces[std::size_t(axis)].begin() + begin, faces[std::size_t(axis)].begin() + end, value);
      });
  }
}

}  // namespace polybed::fluid
