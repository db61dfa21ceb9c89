// Single sphere, Schiller and Naumann 1933.
#pragma once

#include <string_view>

#include "closures/drag_value.hpp"
#include "closures/elementary.hpp"

namespace polybed::closures {

struct DragSchillerNaumann {
  static constexpr std::string_view name = "schiller_naumann";
  static constexpr std::string_view help = "one sphere, Re < 1000";
  static constexpr std::string_view source = "Schiller and Naumann 1933";
  Guard guard = Guard::on;
  /// f = 1 + 0.15 Re^0.687; the guard max(f, 0.44 Re/24) takes over, continuously, at Re 989.
  DragValue operator()(double, double re) const {
    const double power = 0.15 * plain_power(re, 0.687), newton = 0.44 / 24 * re;
    const bool beyond = guard == Guard::on && newton > 1 + power;
    return {beyond ? newton : 1 + power, beyond ? newton : 0.687 * power};
  }
  [[nodiscard]] bool outside(double voidage, double re) const { return voidage < 1 || re > 1000; }
};

}  // namespace polybed::closures
