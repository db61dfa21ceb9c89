// Single sphere, Dallavalle 1948.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "closures/drag_value.hpp"

namespace polybed::closures {

struct DragDallavalle {
  static constexpr std::string_view name = "dallavalle";
  static constexpr std::string_view help = "one sphere";
  static constexpr std::string_view source = "Dallavalle 1948";
  Guard guard = Guard::on;
  /// f = (0.63 sqrt(Re) + 4.8)^2 / 24: finite at Re = 0, where it is 0.96.
  DragValue operator()(double, double re) const {
    const double root = 0.63 * std::sqrt(std::max(re, 0.0)), sum = root + 4.8;
    return {sum * sum / 24, sum * root / 24};
  }
  [[nodiscard]] bool outside(double voidage, double) const { return voidage < 1; }
};

}  // namespace polybed::closures
