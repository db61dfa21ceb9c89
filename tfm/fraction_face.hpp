// Upwind value of a fraction at a face.
#pragma once

#include <algorithm>

#include "core/numerics/operators.hpp"

namespace polybed::tfm {

/// core::LimitedFace for a non-negative quantity such as a fraction: the half slope is limited to the value of the
/// upwind cell, and is 0 if that is negative. The limit has no effect on non-negative values, since half a slope is at
/// most (1 + sqrt 2)/4 of the smaller difference. Without it a face could take more from a cell that an integrator has
/// made negative, so that a deficit grows instead of decaying.
struct LimitedFractionFace {
  static double at(const double* q, core::Index c, core::Index s, double u) {
    const double below = q[c - s] - q[c - 2 * s], here = q[c] - q[c - s], above = q[c + s] - q[c];
    const double from = u > 0 ? q[c - s] : q[c], slope = core::limited_slope(u > 0 ? below : above, here);
    const double half = 0.5 * (u > 0 ? slope : -slope), most = std::max(from, 0.0);
    return from + std::min(std::max(half, -most), most);
  }
};

}  // namespace polybed::tfm
