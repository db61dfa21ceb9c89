// Ergun and Wen-Yu combined, Huilin and Gidaspow 2003.
#pragma once

#include <numbers>
#include <string_view>

#include "closures/drag_ergun.hpp"
#include "closures/drag_wen_yu.hpp"
#include "closures/elementary.hpp"

namespace polybed::closures {

struct DragGidaspow {
  static constexpr std::string_view name = "gidaspow";
  static constexpr std::string_view help = "ergun where the bed is dense, joined to wen_yu where it is open";
  static constexpr std::string_view source = "Huilin and Gidaspow 2003";
  Guard guard = Guard::on;
  /// f = (1-psi) f_Ergun + psi f_WenYu, psi = 1/2 + arctan[262.5 (0.2 - phi)]/pi. Bare: the sharp switch at 0.8.
  DragValue operator()(double eps, double re) const {
    const DragValue dense = DragErgun{guard}(eps, re), dilute = DragWenYu{guard}(eps, re);
    const double psi =
        guard == Guard::on ? 0.5 + plain_arctan(262.5 * (eps - 0.8)) / std::numbers::pi : (eps < 0.8 ? 0.0 : 1.0);
    return {(1 - psi) * dense.f + psi * dilute.f, (1 - psi) * dense.re_dfdre + psi * dilute.re_dfdre};
  }
  [[nodiscard]] bool outside(double, double) const { return false; }
};

}  // namespace polybed::closures
