// What has left the box through the opening in its bottom.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/energy_sum.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

/// Particles are taken out when the list of pairs is made anew, once they lie `fall` below the bottom. The same on
/// every rank, and on any number of ranks to the bit.
struct Outflow {
  double fall = 0;                   ///< m, of centres
  std::vector<std::int64_t> number;  ///< of each species, since the start
  std::int64_t steps = 0;            ///< that all of them took together before they left
  /// What they took with them, in the unit of energy: of motion, spin and gravity, and in the springs of all contacts
  /// that they were in.
  EnergySum energy;

  [[nodiscard]] bool takes(const Place& place) const { return place.x[1] < -fall; }
  /// Particles of all species.
  [[nodiscard]] std::int64_t all() const {
    std::int64_t sum = 0;
    for (const std::int64_t n : number) sum += n;
    return sum;
  }
};

}  // namespace polybed::dem
