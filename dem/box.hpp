// The space of the particles: its size, which faces are walls, and where the images of a particle lie.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "dem/particles.hpp"

namespace polybed::dem {

/// A flat wall, at rest, on one face of the box.
struct Wall {
  int axis = 0;      ///< 0, 1, 2
  int side = 0;      ///< 0: at 0, 1: at the far end
  double place = 0;  ///< m
};

struct Box {
  Vector size{};  ///< along x, y (up), z, m
  std::array<bool, 3> periodic{};
  std::vector<Wall> walls;  ///< of the directions that are not periodic; none where the box is open
  double shear_rate = 0;    ///< of Lees and Edwards: d v_x/d y, 1/s; then y is periodic

  /// What is added to x and v_x of the image of a particle one box up, at a time, m and m/s. The first within +-L/2.
  [[nodiscard]] double image_shift(double time) const {
    const double shift = std::fmod(shear_rate * size[1] * time, size[0]);
    return shift > 0.5 * size[0] ? shift - size[0] : (shift < -0.5 * size[0] ? shift + size[0] : shift);
  }
  [[nodiscard]] double image_speed() const { return shear_rate * size[1]; }
};

/// The images of one instant, as a kernel needs them: a distance beyond `half` is shortened by `period`.
struct Images {
  Vector period{}, half{};
  double shift = 0, speed = 0;  ///< in x, of the image one box up

  Images(const Box& box, double time) : shift(box.image_shift(time)), speed(box.image_speed()) {
    for (std::size_t k = 0; k < 3; ++k) {
      period[k] = box.periodic[k] ? box.size[k] : 0;
      half[k] = box.periodic[k] ? 0.5 * box.size[k] : std::numeric_limits<double>::infinity();
    }
  }

  /// How many boxes lie between two particles at a distance d along an axis: -1, 0 or 1.
  [[nodiscard]] double boxes(double d, std::size_t axis) const {
    return (d > half[axis] ? 1.0 : 0.0) - (d < -half[axis] ? 1.0 : 0.0);
  }

  /// Shortens x_i - x_j to the nearest image of j. Returns what to subtract from v_i - v_j along x.
  double shorten(double& dx, double& dy, double& dz) const {
    const double up = boxes(dy, 1);
    dy -= up * period[1];
    dz -= boxes(dz, 2) * period[2];
    dx -= up * shift;
    dx -= boxes(dx, 0) * period[0];
    return up * speed;
  }
};

/// Greatest number and range of forces that a sum in whole units holds, and the unit. Sums of int64 do not depend on
/// their order, so that neither ranks nor the order of pairs change a bit.
struct FixedPoint {
  double per_unit = 1, unit = 1;  ///< 1/unit and unit, a power of two; N, or N m, or J

  /// Unit for sums of at most `terms` numbers of at most `most` each: the largest power 2^q with most terms 2^q < 2^62.
  static FixedPoint for_sums_of(double most, double terms) {
    const int q = int(std::floor(62 - std::log2(most * terms)));
    return {std::ldexp(1.0, q), std::ldexp(1.0, -q)};
  }
};

}  // namespace polybed::dem
