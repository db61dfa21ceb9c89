// What counts for a fluid of the particles that are coming in through feeds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "closures/sphere.hpp"
#include "core/case/choices.hpp"
#include "dem/box.hpp"
#include "measures/particle_profile.hpp"

namespace polybed::dem {

/// The particles that have entered last. Each counts as far as it would be inside if it came through its face at the
/// feed's velocity; one that has moved on further counts as far as it has moved.
struct Arrivals {
  struct One {
    double way;  ///< at the feed's velocity since it has entered, m
    core::ColumnFace at;
  };
  std::int64_t first = std::numeric_limits<std::int64_t>::max();  ///< number of the first; those below it are inside
  std::vector<One> of;                                            ///< from the first on

  /// Share of the volume.
  [[nodiscard]] double share(const Box& box, const Place& place, std::int64_t id) const {
    if (id < first) return 1;
    const One& one = of[std::size_t(id - first)];
    const auto axis = std::size_t(axis_of(one.at));
    const double from_face = box.round && is_side(one.at) ? 0.5 * box.size[0] - box.from_axis(place.x)
                             : side_of(one.at) == 0       ? place.x[axis]
                                                          : box.size[axis] - place.x[axis];
    const double r = place.radius, way = std::max(one.way, from_face - r);
    return measures::sphere_volume_below(r, r - way, 0) / closures::sphere_volume(r);
  }
};

}  // namespace polybed::dem
