// Value of a fraction at a face, from the side that the solids come from.
#pragma once

#include <algorithm>

#include "core/numerics/operators.hpp"

namespace polybed::tfm {

/// core::LimitedFace of a quantity that is not below 0, such as a fraction: the half slope is at most what the cell
/// that the flow leaves has, and 0 if that is less than nothing. Where no value is below 0 the bound says nothing,
/// since half a slope is at most (1 + sqrt 2)/4 of the smaller difference; where an integrator has left one, a face
/// without it may take from a cell that has less than nothing, so that a deficit grows instead of decaying.
struct LimitedFractionFace {
  static double at(const double* q, core::Index c, core::Index s, double u) {
    const double below = q[c - s] - q[c - 2 * s], here = q[c] - q[c - s], above = q[c + s] - q[c];
    const double from = u > 0 ? q[c - s] : q[c], slope = core::limited_slope(u > 0 ? below : above, here);
    const double half = 0.5 * (u > 0 ? slope : -slope), most = std::max(from, 0.0);
    return from + std::min(std::max(half, -most), most);
  }
};

}  // namespace polybed::tfm
