#include "fluid/boundaries.hpp"

#include <algorithm>

#include "core/numerics/metric.hpp"

namespace polybed::fluid {

using core::Field;
using core::for_each_layer_row;
using core::Index;

std::vector<core::ColumnFace> crossed_sides(const core::Scene& scene) {
  std::vector<core::ColumnFace> sides;
  const auto see = [&](const auto& parts) {
    for (const auto& part : parts)
      if (is_side(part.at) && std::find(sides.begin(), sides.end(), part.at) == sides.end()) sides.push_back(part.at);
  };
  see(scene.jets);
  see(scene.feeds);
  see(scene.discharges);
  return sides;
}

/// Fills ghost layers with sign times the mirror image about the boundary face, for entries on cells or faces of any
/// axis.
void Boundaries::fill_beyond(Field& field, int axis, double sign_low, double sign_high, bool on_faces) const {
  const int n = grid_.cells[std::size_t(axis)];
  const Index s = grid_.stride(axis);
  for (int layer = 1; layer <= grid_.ghosts(axis); ++layer) {
    const int low = -layer, low_mirror = on_faces ? layer : layer - 1;
    if (grid_.ends(axis, 0))
      for_each_layer_row(grid_, axis, low, [&](Index begin, Index end) {
        const Index shift = (std::min(low_mirror, n - 1) - low) * s;
        for (Index c = begin; c < end; ++c) field[std::size_t(c)] = sign_low * field[std::size_t(c + shift)];
      });
    const int high = on_faces ? n + layer : n - 1 + layer, high_mirror = n - layer;
    if (high >= n + grid_.ghosts(axis) || !grid_.ends(axis, 1)) continue;
    for_each_layer_row(grid_, axis, high, [&](Index begin, Index end) {
      const Index shift = (high - std::max(high_mirror, 0)) * s;
      for (Index c = begin; c < end; ++c) field[std::size_t(c)] = sign_high * field[std::size_t(c - shift)];
    });
  }
}

/// At the ends the vertical velocity continues unchanged beyond the distributor and the outlet.
void Boundaries::copy_outward(Field& u) const {
  const Index s = grid_.stride(1);
  const int n = grid_.cells[1];
  if (grid_.ends(1, 1))
    for_each_layer_row(grid_, 1, n + 1, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) u[std::size_t(c)] = u[std::size_t(c - s)];
    });
  for (int layer = -1; layer >= -grid_.ghosts(1) && grid_.ends(1, 0); --layer)
    for_each_layer_row(grid_, 1, layer, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) u[std::size_t(c)] = u[std::size_t(c + s)];
    });
}

/// Whether the low end along a grid axis is the symmetry axis of the column.
bool Boundaries::begins_at_axis(int axis) const { return axis == 0 && grid_.metric && grid_.metric->around_axis; }

/// Fills the ghosts beyond the column's ends across one axis.
void Boundaries::fill_walls(const Ghosts& wanted, int axis) const {
  if (wanted.kind == Ghosts::Kind::joined) return;
  const double along_wall = wanted.slip == WallSlip::no_slip ? -1 : 1;
  const bool open_top = axis == 1 && has_outlet();
  if (wanted.kind == Ghosts::Kind::cells)
    fill_beyond(*wanted.field, axis, 1, 1, false);
  else if (axis == wanted.component)
    fill_beyond(*wanted.field, axis, -1, -1, true);
  else
    fill_beyond(*wanted.field, axis, begins_at_axis(axis) ? 1 : along_wall, open_top ? 1 : along_wall, false);
}

void Boundaries::fill(std::span<const Ghosts> wanted) const {
  exchanged_.clear();
  for (const Ghosts& ghosts : wanted) exchanged_.push_back(ghosts.field);
  for (int axis = 0; axis < grid_.dimensions; ++axis) {
    halo_.exchange(exchanged_, axis);
    for (const Ghosts& ghosts : wanted) fill_walls(ghosts, axis);
  }
  for (const Ghosts& ghosts : wanted)
    if (ghosts.kind == Ghosts::Kind::velocity && ghosts.component == 1 && !closed()) copy_outward(*ghosts.field);
}

void Boundaries::fill_cells(Field& field) const { fill_cells(std::span(&field, 1)); }

void Boundaries::fill_cells(std::span<Field> fields) const {
  wanted_.clear();
  for (Field& field : fields) wanted_.push_back({Ghosts::Kind::cells, &field});
  fill(wanted_);
}

void Boundaries::fill_velocity(core::FaceField& velocity, WallSlip slip) const {
  wanted_.clear();
  for (int component = 0; component < grid_.dimensions; ++component)
    wanted_.push_back({Ghosts::Kind::velocity, &velocity[std::size_t(component)], component, slip});
  fill(wanted_);
}

void Boundaries::join(Field& on_faces, int axis) const {
  Field* const field = &on_faces;
  halo_.exchange(std::span(&field, 1), axis);
}

void Boundaries::join(core::FaceField& faces, core::FaceField& others) const {
  for (int axis = 0; axis < grid_.dimensions; ++axis) {
    const std::array<Field*, 2> both{&faces[std::size_t(axis)], &others[std::size_t(axis)]};
    halo_.exchange(both, axis);
  }
}

}  // namespace polybed::fluid
