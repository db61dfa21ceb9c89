// What counts for a fluid of the particles that are coming in through feeds.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace polybed::dem {

/// Of the particles that have entered last the share of the volume that would be inside if each came through its face
/// at the feed's velocity.
struct Arrivals {
  std::int64_t first = std::numeric_limits<std::int64_t>::max();  ///< number of the first; those below it are inside
  std::vector<double> share;                                      ///< of the volume, of each from the first on

  [[nodiscard]] double share_of(std::int64_t id) const { return id < first ? 1 : share[std::size_t(id - first)]; }
};

}  // namespace polybed::dem
