// Walls of finite thickness inside a column: how far a point is from them, and the open shares that they leave.
//
// The profile of a wall stands in wall_profile.hpp: the DEM lets particles touch the same surface.
#pragma once

#include <limits>
#include <span>

#include "core/case/scene.hpp"
#include "core/numerics/metric.hpp"
#include "core/numerics/wall_profile.hpp"

namespace polybed::core {

/// A place's distance from the nearest wall, m, below 0 inside it, and the direction away from that wall.
struct FromWall {
  double distance;
  std::array<double, 3> away;
  std::size_t wall = 0;  ///< its place in the case, from 0
};

class InnerWalls {
 public:
  /// Ignores walls without thickness, which are for particles alone.
  /// \param size  of the column, m  \param rings  x is the distance from the axis
  InnerWalls(std::span<const InnerWall> walls, const std::array<double, 3>& size, bool rings);

  [[nodiscard]] bool empty() const { return parts_.empty(); }
  [[nodiscard]] FromWall nearest(const std::array<double, 3>& place) const;
  /// Its distance alone.
  [[nodiscard]] double distance(const std::array<double, 3>& place) const { return find(place).distance; }

 private:
  struct Part {
    WallProfile profile;
    bool round;
    std::size_t wall;
  };
  struct Found {
    const Part* part = nullptr;
    double distance = std::numeric_limits<double>::infinity();
    double radius = 0;  ///< of the place
  };
  [[nodiscard]] Found find(const std::array<double, 3>& place) const;
  std::vector<Part> parts_;
  double axis_x_, axis_z_;
  bool rings_;
};

/// Share of a box of widths w that lies where distance + along . (x - centre) > 0, for a unit vector `along`.
[[nodiscard]] double share_beyond(double distance, const std::array<double, 3>& along, const std::array<double, 3>& w);

/// Cuts the layers of a column: open volumes of cells and open areas of faces. A cell that is less than half open gives
/// its volume to the neighbour across its largest face, and its other faces to that neighbour's. Closes all cells that
/// cannot be reached from the largest connected part. Throws StartError if that part does not reach both ends, or if
/// a closed part has a whole cell: particles would find room in it.
/// \param layers  as of cross_sections(), one entry a layer and one for the top  \param column  all of it
[[nodiscard]] std::vector<CrossSection> cut_by_walls(const Grid& column, const InnerWalls& walls, bool rings,
                                                     const std::vector<CrossSection>& layers);

}  // namespace polybed::core
