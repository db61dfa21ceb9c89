// A horizontal slab of a bed that stands on a distributor: the weight by which its means are taken.
#pragma once

#include <cmath>
#include <numbers>

namespace polybed::multiscale {

/// A Gaussian about a height, cut off at a floor and of integral 1 above it. Without the cut the part of it below the
/// floor sees no stress, while a balance of the forces above sees the distributor's there: what bears on it, times that
/// part, is what the two differ by. Lengths in m, all finite, deviation above 0.
struct Slab {
  double place, deviation;
  double floor;  ///< of what is averaged: 0 of volume, the radius of what the centres of spheres pass on

  /// Of a height above the floor, 1/m.
  [[nodiscard]] double weight(double y) const {
    const double z = (y - place) / deviation;
    return std::exp(-0.5 * z * z) / (std::sqrt(2 * std::numbers::pi) * deviation * (1 - up_to(floor)));
  }
  /// Integral of the weight from the floor to y, 0 to 1: the share of the slab that a force at y presses on.
  [[nodiscard]] double below(double y) const { return (up_to(y) - up_to(floor)) / (1 - up_to(floor)); }

 private:
  /// Of the whole Gaussian.
  [[nodiscard]] double up_to(double y) const { return 0.5 * std::erfc((place - y) / (std::sqrt(2.0) * deviation)); }
};

}  // namespace polybed::multiscale
