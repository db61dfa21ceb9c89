#include "multiscale/card/discharge.hpp"

#include <algorithm>
#include <cmath>

#include "closures/hopper_discharge.hpp"
#include "closures/mixture.hpp"
#include "closures/sphere.hpp"

namespace polybed::multiscale {

namespace {

/// Width of the opening, m, or of the lower end of a cone above it if that is narrower; nothing between other walls.
std::optional<double> free_opening(const core::Scene& scene) {
  std::optional<double> width = scene.dem.opening;
  for (const core::InnerWall& wall : scene.walls) {
    if (wall.shape != core::WallShape::cone) return {};
    const std::vector<double>& low = wall.from[1] < wall.to[1] ? wall.from : wall.to;
    if (width) width = std::min(*width, low[0] - wall.thickness);
    if (low[0] > std::max(wall.from[0], wall.to[0]) - 1e-12) return {};  // it widens downwards
  }
  return width;
}

}  // namespace

std::optional<ExpectedDischarge> expected_discharge(const core::Scene& scene, const std::vector<double>& share,
                                                    double gravity) {
  const bool counted = scene.bed.particles.size() == scene.species.size();
  const std::optional<double> width = free_opening(scene);
  if (!width || share.empty() || !counted || !(scene.bed.solids_fraction > 0 && gravity > 0)) return {};
  std::vector<double> diameter;
  double mass = 0, density = 0;
  for (std::size_t j = 0; j < share.size(); ++j) {
    const core::Species& species = scene.species[j];
    diameter.push_back(species.diameter);
    density += share[j] * species.density;
    mass += double(scene.bed.particles[j]) * species.density * closures::sphere_volume(species.diameter / 2);
  }
  const double mean = closures::sauter_diameter(share, diameter);
  const double depth = scene.column.dimensions == 2 ? scene.column.size[2] : 0;  // a slot; else a round hole
  return ExpectedDischarge{
      closures::hopper_discharge(*width, depth, mean, scene.bed.solids_fraction * density, gravity), mass,
      *width / mean, !scene.column.is_tapered() && scene.walls.empty(), !scene.walls.empty()};
}

}  // namespace polybed::multiscale
