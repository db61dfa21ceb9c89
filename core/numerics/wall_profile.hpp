// The profile of a wall inside a column, in its plane: the one geometry that cuts the fluid's cells and that particles
// touch.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace polybed::core {

/// A point in the plane of a wall's profile, m: x and y, or distance from the axis and y.
using InPlane = std::array<double, 2>;

/// All points within half a thickness of a straight middle, so that edges are rounded; of a rod the middle is a point.
struct WallProfile {
  double x = 0, y = 0;              ///< of one edge, m
  double along_x = 1, along_y = 0;  ///< to the other edge, m
  double per_square = 1;            ///< 1 over the square of their distance, 1/m2; 0 for a rod
  double half = 0;                  ///< of its thickness, m

  WallProfile() = default;
  WallProfile(double x0, double y0, double x1, double y1)
      : x(x0),
        y(y0),
        along_x(x1 - x0),
        along_y(y1 - y0),
        per_square(along_x == 0 && along_y == 0 ? 0 : 1 / (along_x * along_x + along_y * along_y)) {}

  /// Position along the middle of its point nearest to another: below 0 and above 1 beyond an edge.
  [[nodiscard]] double share(const InPlane& point) const {
    return ((point[0] - x) * along_x + (point[1] - y) * along_y) * per_square;
  }
  /// Vector to a point from the nearest point on the middle, m.
  [[nodiscard]] InPlane from_middle(const InPlane& point) const {
    const double within = std::clamp(share(point), 0.0, 1.0);
    return {point[0] - x - within * along_x, point[1] - y - within * along_y};
  }
  /// Its length, m.
  [[nodiscard]] double distance_from_middle(const InPlane& point) const {
    const InPlane away = from_middle(point);
    return std::sqrt(away[0] * away[0] + away[1] * away[1]);
  }
  /// Distance of a point from the surface, m; below 0 inside.
  [[nodiscard]] double gap(const InPlane& point) const { return distance_from_middle(point) - half; }
  /// Vector to a point outside from the nearest point on the surface, m.
  [[nodiscard]] InPlane to(const InPlane& point) const {
    const InPlane away = from_middle(point);
    if (half == 0) return away;
    const double beyond = 1 - half / std::sqrt(away[0] * away[0] + away[1] * away[1]);
    return {beyond * away[0], beyond * away[1]};
  }
};

}  // namespace polybed::core
