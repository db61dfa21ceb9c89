// The open top of a column: how much of a particle that passes it counts for the fluid.
#pragma once

#include <algorithm>

#include "closures/sphere.hpp"
#include "dem/coupling/weights.hpp"
#include "measures/particle_profile.hpp"

namespace polybed::dem {

/// A particle counts as far as it is inside; the part beyond the top is dropped. Its share falls from 1 to 0 while its
/// centre rises from a radius below the top to a radius above it, so that the voidage has no jump. Beyond the top its
/// weight on the faces there mirrors the weight below: then the flux through them, summed over the passage of a
/// particle, is its volume, whatever its speed and the height of the cells.
class OpenTop {
 public:
  /// \param grid  of the whole column
  explicit OpenTop(const core::Grid& grid) : height_(grid.cells[1] * grid.spacing[1]), spacing_(grid.spacing[1]) {}

  /// Whether a part of the particle, or all of it, is beyond the top.
  [[nodiscard]] bool cuts(const Place& place) const { return place.x[1] + place.radius > height_; }
  /// Share of its volume that is inside.
  [[nodiscard]] double inside(const Place& place) const {
    return measures::sphere_volume_below(place.radius, place.x[1], height_) / closures::sphere_volume(place.radius);
  }
  /// What is left of its shares on faces along y without those beyond the top.
  [[nodiscard]] double on_faces(const Place& place) const {
    return std::clamp(1 - (place.x[1] - height_) / spacing_, 0.0, 1.0);
  }

 private:
  double height_, spacing_;  ///< of the column, of a cell, m
};

}  // namespace polybed::dem
