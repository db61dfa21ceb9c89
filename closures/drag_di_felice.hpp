// All voidages, Di Felice 1994, T(3.30).
#pragma once

#include <cmath>
#include <string_view>

#include "closures/drag_dallavalle.hpp"

namespace polybed::closures {

struct DragDiFelice {
  static constexpr std::string_view name = "di_felice";
  static constexpr std::string_view help = "bed of any voidage";
  static constexpr std::string_view source = "Cello 2009, eq. 3.30";
  Guard guard = Guard::on;
  /// f = f_Dallavalle(Re) eps^-p, p = 3.7 - 0.65 exp[-(1.5 - log10 Re)^2/2]; p = 3.7 at Re = 0.
  DragValue operator()(double eps, double re) const {
    const DragValue single = DragDallavalle{}(eps, re);
    if (!(re > 0)) return {single.f * std::pow(eps, -3.7), 0};
    const double x = 1.5 - std::log10(re), bump = 0.65 * std::exp(-0.5 * x * x);
    const double log_eps = std::log(eps), crowding = std::exp((bump - 3.7) * log_eps);
    const double slope = bump * x / std::log(10.0) * log_eps;  // d ln(crowding) / d ln Re
    return {crowding * single.f, crowding * (single.re_dfdre + single.f * slope)};
  }
  [[nodiscard]] bool outside(double, double) const { return false; }
};

}  // namespace polybed::closures
