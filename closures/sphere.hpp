// Geometry of a spherical particle. All SI.
#pragma once

#include <numbers>

namespace polybed::closures {

/// V = (4/3) pi R^3, m3. radius >= 0.
[[nodiscard]] inline double sphere_volume(double radius) {
  return 4.0 / 3 * std::numbers::pi * radius * radius * radius;
}

}  // namespace polybed::closures
