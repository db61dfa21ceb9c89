// Velocity and vorticity of the fluid in the cells of a whole column, from its velocities at cell centres.
#pragma once

#include <array>
#include <vector>

#include "closures/vec3.hpp"

namespace polybed::multiscale {

struct FluidMap {
  int dimensions = 2;
  std::array<int, 3> cells{1, 1, 1};
  std::array<double, 3> spacing{1, 1, 1};  ///< m
  bool walls = true;                       ///< sides: no slip; else joined
  std::vector<closures::Vec3> velocity;    ///< [z][y][x], m/s

  [[nodiscard]] std::size_t index(int i, int j, int k) const {
    return std::size_t(i) + std::size_t(cells[0]) * (std::size_t(j) + std::size_t(cells[1]) * std::size_t(k));
  }
  /// The cell of a place, m; the nearest one of a place outside.
  [[nodiscard]] std::array<int, 3> cell_at(const std::array<double, 3>& place) const;
  /// Linear between centres, m/s.
  [[nodiscard]] closures::Vec3 velocity_at(const std::array<double, 3>& place) const;
  /// curl U of a cell, 1/s, by differences over two cells; the image behind a wall moves the other way, at the ends
  /// the last cell stands for the one beyond.
  [[nodiscard]] closures::Vec3 vorticity(const std::array<int, 3>& cell) const;

 private:
  [[nodiscard]] closures::Vec3 neighbour(std::array<int, 3> cell, int axis, int step) const;
};

}  // namespace polybed::multiscale
