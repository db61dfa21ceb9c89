// Packed bed, Ergun 1952, T(3.24).
#pragma once

#include <algorithm>
#include <string_view>

#include "closures/drag_value.hpp"

namespace polybed::closures {

struct DragErgun {
  static constexpr std::string_view name = "ergun";
  static constexpr std::string_view help = "packed bed; measured at voidage 0.43-0.54, used to 0.8";
  static constexpr std::string_view source = "Ergun 1952; Cello 2009, eq. 3.24";
  Guard guard = Guard::on;
  /// f = (150/18)(1-eps)/eps^2 + (1.75/18) Re/eps^2.
  DragValue operator()(double eps, double re) const {
    const double inertia = 1.75 / 18 * re / (eps * eps);
    return {150.0 / 18 * std::max(1 - eps, 0.0) / (eps * eps) + inertia, inertia};
  }
  [[nodiscard]] bool outside(double eps, double) const { return eps > 0.8; }
};

}  // namespace polybed::closures
