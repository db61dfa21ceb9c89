// A horizontal slab of a bed on a distributor: the weight for its means.
#pragma once

#include <cmath>
#include <numbers>

namespace polybed::multiscale {

/// A Gaussian about a height, cut off at a floor and with integral 1 above it. Without the cut its part below the floor
/// would see no stress, while a balance of the forces above includes the distributor's force there: the two would
/// differ by the load on it times that part. Lengths in m, all finite, deviation above 0.
struct Slab {
  double place, deviation;
  double floor;  ///< of the averaged quantity: 0 for volume, the sphere radius for fluxes through centres

  /// At a height above the floor, 1/m.
  [[nodiscard]] double weight(double y) const {
    const double z = (y - place) / deviation;
    return std::exp(-0.5 * z * z) / (std::sqrt(2 * std::numbers::pi) * deviation * (1 - up_to(floor)));
  }
  /// Integral of the weight from the floor to y, 0 to 1: the share of the slab below a force at y.
  [[nodiscard]] double below(double y) const { return (up_to(y) - up_to(floor)) / (1 - up_to(floor)); }

 private:
  /// Integral of the whole Gaussian.
  [[nodiscard]] double up_to(double y) const { return 0.5 * std::erfc((place - y) / (std::sqrt(2.0) * deviation)); }
};

}  // namespace polybed::multiscale
