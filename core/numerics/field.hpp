// Fields over the padded box of a grid, and the boxes of owned cells and faces for loops.
#pragma once

#include <array>
#include <vector>

#include "core/numerics/grid.hpp"

namespace polybed::core {

/// One number per entry of the padded box: for a cell, or for its low face along one axis.
using Field = std::vector<double>;

/// One number per face, axis by axis. Axes that a 2-D grid lacks are empty.
using FaceField = std::array<Field, 3>;

[[nodiscard]] inline Field make_field(const Grid& grid, double value = 0) { return Field(grid.padded_size(), value); }

[[nodiscard]] inline FaceField make_face_field(const Grid& grid, double value = 0) {
  FaceField field;
  for (int axis = 0; axis < grid.dimensions; ++axis) field[std::size_t(axis)] = make_field(grid, value);
  return field;
}

/// A box of entries, lo <= (i, j, k) < hi.
struct Box {
  std::array<int, 3> lo, hi;
};

[[nodiscard]] inline Box owned_cells(const Grid& grid) { return {{0, 0, 0}, grid.cells}; }

/// All faces of an axis that the block owns, including those on the column's boundary.
[[nodiscard]] inline Box owned_faces(const Grid& grid, int axis) {
  Box box = owned_cells(grid);
  box.hi[std::size_t(axis)] = grid.faces(axis);
  return box;
}

/// The owned faces of an axis with a cell of the column (or, across periodic sides, its image) on either side.
[[nodiscard]] inline Box interior_faces(const Grid& grid, int axis) {
  Box box = owned_cells(grid);
  if (grid.ends(axis, 0)) box.lo[std::size_t(axis)] = 1;
  return box;
}

/// Calls body(begin, end) for every contiguous row of a box.
template <class Body>
void for_each_row(const Grid& grid, const Box& box, Body&& body) {
  for_each_row(grid, box.lo, box.hi, body);
}

}  // namespace polybed::core
