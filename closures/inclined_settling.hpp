// Settling between parallel plates that lean: clear fluid forms under the upper plate and rises along it (Boycott
// 1920).
#pragma once

#include <cmath>

namespace polybed::closures {

/// Length, m, that a suspension still fills of a channel after a time, measured along it. Ponder (1925) and Nakamura
/// and Kuroda (1937), as Acrivos and Herbolzheimer (1979) have it, from memory: clear fluid forms over what the
/// suspension covers of a level surface, dL/dt = -v (cos a + (L/b) sin a). Range: a clear layer much thinner than the
/// channel and sediment that slides down at once; below 0 there is none left.
/// \param start     L at time 0, m
/// \param width     b, distance of the plates, m
/// \param velocity  v, at which the suspension settles in an upright vessel, m/s
/// \param angle     a, of the plates to the vertical, 0 to below pi/2
/// \param time      s
[[nodiscard]] inline double suspension_length(double start, double width, double velocity, double angle, double time) {
  if (angle == 0) return start - velocity * time;
  const double end = -width / std::tan(angle);
  return end + (start - end) * std::exp(-velocity * std::sin(angle) * time / width);
}

}  // namespace polybed::closures
