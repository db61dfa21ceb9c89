// An opening in the bottom of the box, and how far particles are from what is left of the bottom.
#pragma once

#include <cmath>

#include "dem/particles.hpp"

namespace polybed::dem {

/// The bottom is a plate at y = 0 without thickness, with a sharp rim: what has passed it meets it from below.
struct Opening {
  double x = 0, z = 0;  ///< of its middle, m
  double half = 0;      ///< half its width, m
  bool round = false;   ///< a hole; else a slot along z

  /// To a centre from the point of the plate that is nearest to it, m: straight above or below the plate, from the rim
  /// within the opening. A sphere that fits through touches one side of the rim at a time.
  [[nodiscard]] Vector from_plate(const Vector& centre) const {
    const double dx = centre[0] - x, dz = round ? centre[2] - z : 0, away = std::sqrt(dx * dx + dz * dz);
    if (away >= half) return {0, centre[1], 0};
    if (away == 0) return {-half, centre[1], 0};
    const double beyond = 1 - half / away;
    return {beyond * dx, centre[1], beyond * dz};
  }
};

}  // namespace polybed::dem
