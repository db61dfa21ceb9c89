// Dilute suspensions, Wen and Yu 1966, T(3.29).
#pragma once

#include <string_view>

#include "closures/drag_schiller_naumann.hpp"
#include "closures/elementary.hpp"

namespace polybed::closures {

struct DragWenYu {
  static constexpr std::string_view name = "wen_yu";
  static constexpr std::string_view help = "expanded bed, voidage > 0.8";
  static constexpr std::string_view source = "Wen and Yu 1966; Cello 2009, eq. 3.29";
  Guard guard = Guard::on;
  /// f = f_SchillerNaumann(Re) eps^-3.65.
  DragValue operator()(double eps, double re) const {
    const DragValue single = DragSchillerNaumann{guard}(eps, re);
    const double crowding = plain_power(eps, -3.65);
    return {crowding * single.f, crowding * single.re_dfdre};
  }
  [[nodiscard]] bool outside(double eps, double re) const { return eps < 0.8 || re > 1000; }
};

}  // namespace polybed::closures
