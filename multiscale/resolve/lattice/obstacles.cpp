#include "multiscale/resolve/lattice/obstacles.hpp"

#include <algorithm>
#include <cmath>

namespace polybed::multiscale::lattice {

std::vector<std::int32_t> Spheres::owners(const Sites& sites) const {
  std::vector<std::int32_t> owner(sites.count(), none);
  std::vector<float> depth(sites.count(), 0);
  for (std::size_t n = 0; n < spheres_.size(); ++n) {
    const Sphere& s = spheres_[n];
    // Indices in the array for images of the sphere, and their distances from its centre.
    std::array<std::vector<std::pair<int, double>>, 3> near;
    for (std::size_t k = 0; k < 3; ++k)
      for (int i = 0; i < sites.box[k] + 2; ++i) {
        double d = i - 1 - s.centre[k];
        d -= box_[k] * std::round(d / box_[k]);
        if (std::abs(d) < s.radius) near[k].emplace_back(i, d);
      }
    for (const auto& [i, x] : near[0])
      for (const auto& [j, y] : near[1])
        for (const auto& [k, z] : near[2]) {
          const double inside = s.radius - std::sqrt(x * x + y * y + z * z);
          const std::size_t at = sites.at(i, j, k);
          if (inside <= 0 || (owner[at] != none && float(inside) <= depth[at])) continue;
          owner[at] = std::int32_t(n);
          depth[at] = float(inside);
        }
  }
  return owner;
}

double Spheres::fraction(std::int32_t owner, const Point& fluid, const std::array<int, 3>& way) const {
  const Sphere& s = spheres_[std::size_t(owner)];
  double length = 0, along = 0, distance = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double d = fluid[k] + way[k] - s.centre[k];  // from the covered site, to its nearest image
    d -= box_[k] * std::round(d / box_[k]);
    d -= way[k];
    length += way[k] * way[k];
    along += way[k] * d;
    distance += d * d;
  }
  // |d + q way| = radius
  const double root = along * along - length * (distance - s.radius * s.radius);
  return std::clamp((-along - std::sqrt(std::max(root, 0.0))) / length, 0.0, 1.0);
}

}  // namespace polybed::multiscale::lattice
