// Single sphere, Schiller and Naumann 1933.
#pragma once

#include <cmath>
#include <string_view>

#include "closures/drag_value.hpp"

namespace polybed::closures {

struct DragSchillerNaumann {
  static constexpr std::string_view name = "schiller_naumann";
  static constexpr std::string_view help = "one sphere, Re < 1000";
  static constexpr std::string_view source = "Schiller and Naumann 1933";
  Guard guard = Guard::on;
  /// f = 1 + 0.15 Re^0.687; guarded by max(f, 0.44 Re/24), which takes over, continuously, at Re 989.
  DragValue operator()(double, double re) const {
    const double power = re > 0 ? 0.15 * std::pow(re, 0.687) : 0.0;
    const double newton = 0.44 / 24 * re;
    if (guard == Guard::on && newton > 1 + power) return {newton, newton};
    return {1 + power, 0.687 * power};
  }
  [[nodiscard]] bool outside(double voidage, double re) const { return voidage < 1 || re > 1000; }
};

}  // namespace polybed::closures
