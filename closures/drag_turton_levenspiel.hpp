// Single sphere, Turton and Levenspiel 1986, T(3.19).
#pragma once

#include <string_view>

#include "closures/drag_value.hpp"
#include "closures/elementary.hpp"

namespace polybed::closures {

struct DragTurtonLevenspiel {
  static constexpr std::string_view name = "turton_levenspiel";
  static constexpr std::string_view help = "one sphere up to the drag crisis: Re < 2.6e5";
  static constexpr std::string_view source = "Turton and Levenspiel 1986; Cello 2009, eq. 3.19";
  Guard guard = Guard::on;
  /// T(Re) = 1 + 0.173 Re^0.657 + (0.413 Re/24)/(1 + 16300 Re^-1.09); Re df/dRe -> 0 at Re = 0 though df/dRe
  /// is infinite.
  DragValue operator()(double, double re) const {
    const double a = 0.173 * plain_power(re, 0.657), power = plain_power(re, 1.09);
    const double b = 0.413 / 24 * re * power / (power + 16300);
    return {1 + a + b, 0.657 * a + b * (1 + 1.09 * 16300 / (power + 16300))};
  }
  [[nodiscard]] bool outside(double voidage, double re) const { return voidage < 1 || re > 2.6e5; }
};

}  // namespace polybed::closures
