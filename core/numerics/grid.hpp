// The staggered grid of a column or of this rank's block, and the memory layout of its fields. Its cells are alike; its
// metric contains the open shares of cells in a round column, and the relative heights of graded layers.
//
// Axes: 0 = x (width), 1 = y (height, upward), 2 = z (depth; one cell thick in 2-D). Every field, on cells or
// on faces of one axis, is one array over the same padded box, so that a cell and its low faces share an
// index: face c of axis a lies between the cells c - stride[a] and c. A block owns the low faces of its cells; where
// the column ends, also the high ones.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace polybed::core {

class Ranks;
struct Metric;

using Index = std::ptrdiff_t;

/// Layers of cells of different heights along an axis, in the whole column.
struct Layers {
  std::vector<double> height;  ///< m, from the bottom up, or from the low end of x or z
  std::vector<double> low;     ///< of their low faces, and the end of the column, m
};

struct Grid {
  static constexpr int halo = 2;  ///< layers of ghost cells on every side of an active axis

  int dimensions = 2;                                 ///< 2 or 3: the number of active axes
  std::array<int, 3> cells{1, 1, 1};                  ///< owned cells along each axis
  std::array<double, 3> spacing{1, 1, 1};             ///< cell size, m (2-D: spacing[2] is the depth); the lowest
                                                      ///< layer's where layers are graded, the smallest
  std::array<bool, 3> periodic{false, false, false};  ///< joined sides

  std::array<int, 3> before{0, 0, 0};    ///< cells of the column on other ranks, towards lower indices
  std::array<int, 3> after{0, 0, 0};     ///< and towards higher ones
  std::array<int, 3> blocks{1, 1, 1};    ///< of the column, along each axis
  std::array<int, 3> block{0, 0, 0};     ///< index of this block
  std::shared_ptr<const Ranks> ranks;    ///< the ranks that own the blocks; null: the whole column is here
  std::shared_ptr<const Layers> layers;  ///< where they are graded along the height; null: all alike
  std::array<std::shared_ptr<const Layers>, 2> across;  ///< the same along x and z
  std::shared_ptr<const Metric> metric;  ///< for a round or graded column; null: every cell is open and alike

  /// Ghost layers along an axis: none along an inactive axis.
  [[nodiscard]] int ghosts(int axis) const { return axis < dimensions ? halo : 0; }
  /// Entries of the padded box along an axis.
  [[nodiscard]] Index extent(int axis) const { return cells[std::size_t(axis)] + 2 * ghosts(axis); }
  /// Distance in memory between neighbours along an axis.
  [[nodiscard]] Index stride(int axis) const { return axis == 0 ? 1 : axis == 1 ? extent(0) : extent(0) * extent(1); }
  /// Entries of a field, ghosts included.
  [[nodiscard]] std::size_t padded_size() const { return std::size_t(extent(0) * extent(1) * extent(2)); }
  /// Cells of the whole column along an axis.
  [[nodiscard]] int column_cells(int axis) const {
    const auto a = std::size_t(axis);
    return before[a] + cells[a] + after[a];
  }
  [[nodiscard]] std::size_t column_cell_count() const {
    return std::size_t(column_cells(0)) * std::size_t(column_cells(1)) * std::size_t(column_cells(2));
  }
  /// Whether the column ends at the low (0) or high (1) side of this block; joined sides are not an end.
  [[nodiscard]] bool ends(int axis, int side) const {
    const auto a = std::size_t(axis);
    return !periodic[a] && (side == 0 ? before[a] : after[a]) == 0;
  }
  /// Whether other ranks own cells of the column along an axis.
  [[nodiscard]] bool divided(int axis) const { return blocks[std::size_t(axis)] > 1; }
  /// Owned cells.
  [[nodiscard]] std::size_t cell_count() const {
    return std::size_t(cells[0]) * std::size_t(cells[1]) * std::size_t(cells[2]);
  }
  /// Index of cell (i, j, k); owned for 0 <= i < cells[0] and so on, ghosts outside.
  [[nodiscard]] Index index(int i, int j, int k = 0) const {
    return (i + ghosts(0)) + extent(0) * ((j + ghosts(1)) + extent(1) * Index(k + ghosts(2)));
  }
  /// Owned faces of an axis along that axis: one more than cells where the column ends.
  [[nodiscard]] int faces(int axis) const { return cells[std::size_t(axis)] + (ends(axis, 1) ? 1 : 0); }
  /// The shortest side of a cell along an active axis, m.
  [[nodiscard]] double smallest_spacing() const {
    return *std::min_element(spacing.begin(), spacing.begin() + dimensions);
  }
  /// Volume of a whole cell, m3.
  [[nodiscard]] double cell_volume() const { return spacing[0] * spacing[1] * spacing[2]; }
  /// The layers along an axis; null: all alike.
  [[nodiscard]] const Layers* graded(int axis) const {
    return axis == 1 ? layers.get() : across[std::size_t(axis / 2)].get();
  }
  /// Side of the column's cell n along an axis, m; beyond the ends the outermost one's.
  [[nodiscard]] double side(int axis, int n) const {
    const Layers* of = graded(axis);
    return of ? of->height[std::size_t(std::clamp(n, 0, column_cells(axis) - 1))] : spacing[std::size_t(axis)];
  }
  /// Height of a layer of the column, m.
  [[nodiscard]] double height(int y) const { return side(1, y); }
  /// Low face of the column's cell n along an axis, m; the column begins at 0.
  [[nodiscard]] double low(int axis, int n) const {
    const Layers* of = graded(axis);
    if (!of) return n * spacing[std::size_t(axis)];
    const int inside = std::clamp(n, 0, column_cells(axis));
    return of->low[std::size_t(inside)] + (n - inside) * side(axis, n);
  }
  /// Side along an axis of the cells at its low (0) or high (1) end, m.
  [[nodiscard]] double size_at_end(int axis, int end) const {
    return side(axis, end == 0 ? 0 : column_cells(axis) - 1);
  }
  [[nodiscard]] double column_height() const { return low(1, column_cells(1)); }
  /// Centre of this block's cell i along an axis, m.
  [[nodiscard]] double centre(int axis, int i) const {
    const int n = before[std::size_t(axis)] + i;
    return graded(axis) ? 0.5 * (low(axis, n) + low(axis, n + 1)) : (n + 0.5) * spacing[std::size_t(axis)];
  }
};

/// Calls body(begin, end) for every row of contiguous cells of the box lo <= (i, j, k) < hi.
template <class Body>
void for_each_row(const Grid& grid, const std::array<int, 3>& lo, const std::array<int, 3>& hi, Body&& body) {
  for (int k = lo[2]; k < hi[2]; ++k)
    for (int j = lo[1]; j < hi[1]; ++j) {
      const Index begin = grid.index(lo[0], j, k);
      body(begin, begin + (hi[0] - lo[0]));
    }
}

/// Calls body(begin, end) for every row of owned cells.
template <class Body>
void for_each_row(const Grid& grid, Body&& body) {
  for_each_row(grid, {0, 0, 0}, grid.cells, body);
}

}  // namespace polybed::core
