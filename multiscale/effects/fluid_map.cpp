#include "multiscale/effects/fluid_map.hpp"

#include <algorithm>
#include <cmath>

namespace polybed::multiscale {

using closures::Vec3;

namespace {

constexpr int vertical = 1;

}  // namespace

Vec3 FluidMap::neighbour(std::array<int, 3> cell, int axis, int step) const {
  const auto a = std::size_t(axis);
  const int n = cells[a], wanted = cell[a] + step;
  const bool outside = wanted < 0 || wanted >= n;
  cell[a] = axis == vertical || walls ? std::clamp(wanted, 0, n - 1) : (wanted + n) % n;
  const Vec3 u = velocity[index(cell[0], cell[1], cell[2])];
  return outside && walls && axis != vertical ? -1.0 * u : u;
}

std::array<int, 3> FluidMap::cell_at(const std::array<double, 3>& place) const {
  std::array<int, 3> cell{0, 0, 0};
  for (std::size_t a = 0; a < std::size_t(dimensions); ++a)
    cell[a] = std::clamp(int(std::floor(place[a] / spacing[a])), 0, cells[a] - 1);
  return cell;
}

Vec3 FluidMap::velocity_at(const std::array<double, 3>& place) const {
  const std::array<int, 3> cell = cell_at(place);
  std::array<int, 3> towards{0, 0, 0};
  std::array<double, 3> weight{0, 0, 0};
  for (std::size_t a = 0; a < std::size_t(dimensions); ++a) {
    const double from_centre = place[a] / spacing[a] - (cell[a] + 0.5);
    towards[a] = from_centre < 0 ? -1 : 1;
    weight[a] = std::min(std::abs(from_centre), 0.5);
  }
  // Towards each side in turn: exact for linear fields, which is all that linear interpolation is.
  const Vec3 here = velocity[index(cell[0], cell[1], cell[2])];
  Vec3 u = here;
  for (int a = 0; a < dimensions; ++a)
    u = u + weight[std::size_t(a)] * (neighbour(cell, a, towards[std::size_t(a)]) - here);
  return u;
}

Vec3 FluidMap::vorticity(const std::array<int, 3>& cell) const {
  const auto slope = [&](int axis) -> Vec3 {
    if (axis >= dimensions) return {0, 0, 0};
    return 0.5 / spacing[std::size_t(axis)] * (neighbour(cell, axis, 1) - neighbour(cell, axis, -1));
  };
  const Vec3 dx = slope(0), dy = slope(1), dz = slope(2);
  return {dy.z - dz.y, dz.x - dx.z, dx.y - dy.x};
}

}  // namespace polybed::multiscale
