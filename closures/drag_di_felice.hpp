// All voidages, Di Felice 1994, T(3.30).
#pragma once

#include <algorithm>
#include <numbers>
#include <string_view>

#include "closures/drag_dallavalle.hpp"
#include "closures/elementary.hpp"

namespace polybed::closures {

struct DragDiFelice {
  static constexpr std::string_view name = "di_felice";
  static constexpr std::string_view help = "bed of any voidage";
  static constexpr std::string_view source = "Di Felice 1994; Cello 2009, eq. 3.30";
  Guard guard = Guard::on;
  /// f = f_Dallavalle(Re) eps^-p, p = 3.7 - 0.65 exp[-(1.5 - log10 Re)^2/2]; p = 3.7 at Re = 0.
  DragValue operator()(double eps, double re) const {
    const DragValue single = DragDallavalle{}(eps, re);
    // At the limits of Re the bump is less than 1e-40.
    const double x = 1.5 - plain_log(std::clamp(re, 1e-13, 1e16)) / std::numbers::ln10;
    const double bump = 0.65 * plain_exp(-0.5 * x * x), crowding = plain_power(eps, bump - 3.7);
    const double slope = bump * x / std::numbers::ln10 * plain_log(eps);  // d ln(crowding) / d ln Re
    return {crowding * single.f, crowding * (single.re_dfdre + single.f * slope)};
  }
  [[nodiscard]] bool outside(double, double) const { return false; }
};

}  // namespace polybed::closures
