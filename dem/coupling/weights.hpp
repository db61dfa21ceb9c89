// The shares of a particle in the surrounding cells and faces, T(2.9): linear in the distance along each direction of
// the grid, counted in cells. Both directions of the coupling have the same weights.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/numerics/grid.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

/// Two neighbours along an axis: their indices in a field, and their shares.
struct Line {
  std::array<core::Index, 2> at{0, 0};
  std::array<double, 2> w{1, 0};
};

/// For a particle, along each axis.
struct Lines {
  std::array<Line, 3> cell, face;
};

/// Height in layers from the bottom; the outermost ones continue beyond the ends.
[[nodiscard]] inline double in_layers(const core::Layers& layers, double height) {
  const std::vector<double>& low = layers.low;
  const auto n = std::upper_bound(low.begin() + 1, low.end() - 1, height) - low.begin() - 1;
  return double(n) + (height - low[std::size_t(n)]) / layers.height[std::size_t(n)];
}

class Weights {
 public:
  /// \param grid  of the whole column
  explicit Weights(const core::Grid& grid) : grid_(grid) {
    for (int axis = 0; axis < grid.dimensions; ++axis) {
      const auto a = std::size_t(axis);
      per_spacing_[a] = 1 / grid.spacing[a];
      stride_[a] = grid.stride(axis);
    }
  }

  /// Shares in cells beyond a wall return inward; those across joined sides go to the other side. Faces on walls have
  /// their share, which is the share of the wall. Particles beyond an end count to its outermost row.
  [[nodiscard]] Lines operator()(const Vector& x) const {
    Lines lines;
    for (std::size_t a = 0; a < std::size_t(grid_.dimensions); ++a) {
      const int n = grid_.cells[a];
      const bool periodic = grid_.periodic[a];
      const double place = a == 1 && grid_.layers ? in_layers(*grid_.layers, x[1]) : x[a] * per_spacing_[a];
      lines.cell[a] = line(place - 0.5, a, periodic ? n : 0, 0, n - 1);
      lines.face[a] = line(place, a, periodic ? n : 0, 0, n);
    }
    return lines;
  }

  [[nodiscard]] int dimensions() const { return grid_.dimensions; }

 private:
  /// \param place  in spacings from entry 0  \param period  0: entries beyond the first and the last are clamped
  [[nodiscard]] Line line(double place, std::size_t a, int period, int first, int last) const {
    const double below = std::floor(place), share = place - below;
    int low = int(below), high = low + 1;
    if (period > 0) {
      // A particle strays by less than a period; one that has jumped, which ends its step, gets any valid place.
      low = std::clamp(low < 0 ? low + period : low >= period ? low - period : low, 0, period - 1);
      high = std::clamp(high < 0 ? high + period : high >= period ? high - period : high, 0, period - 1);
    } else {
      low = std::clamp(low, first, last);
      high = std::clamp(high, first, last);
    }
    const core::Index ghosts = core::Grid::halo;
    return {{(low + ghosts) * stride_[a], (high + ghosts) * stride_[a]}, {1 - share, share}};
  }

  core::Grid grid_;
  std::array<double, 3> per_spacing_{};
  std::array<core::Index, 3> stride_{};
};

/// Calls body(at, share) for the entries in the product of three lines. \param dimensions  2 or 3
template <class Body>
void for_each_share(int dimensions, const Line& x, const Line& y, const Line& z, Body&& body) {
  const int layers = dimensions == 3 ? 2 : 1;
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i)
        body(std::size_t(x.at[std::size_t(i)] + y.at[std::size_t(j)] + z.at[std::size_t(k)]),
             x.w[std::size_t(i)] * y.w[std::size_t(j)] * z.w[std::size_t(k)]);
}

/// For the cells around a particle.
template <class Body>
void for_each_cell(int dimensions, const Lines& lines, Body&& body) {
  for_each_share(dimensions, lines.cell[0], lines.cell[1], lines.cell[2], body);
}

/// For the faces of an axis around it.
template <class Body>
void for_each_face(int dimensions, const Lines& lines, int axis, Body&& body) {
  const auto along = [&](int a) -> const Line& {
    return a == axis ? lines.face[std::size_t(a)] : lines.cell[std::size_t(a)];
  };
  for_each_share(dimensions, along(0), along(1), along(2), body);
}

}  // namespace polybed::dem
