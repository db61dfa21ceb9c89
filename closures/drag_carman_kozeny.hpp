// Packed bed in creeping flow, Carman 1937, T(3.23).
#pragma once

#include <algorithm>
#include <string_view>

#include "closures/drag_value.hpp"

namespace polybed::closures {

struct DragCarmanKozeny {
  static constexpr std::string_view name = "carman_kozeny";
  static constexpr std::string_view help = "packed bed, creeping flow: Re < 1; no drag on a lone sphere";
  static constexpr std::string_view source =
      "Kozeny 1927, Carman 1937; Cello 2009, eq. 3.23, kappa 5; 0, not 1, at voidage 1";
  Guard guard = Guard::on;
  /// f = 2 kappa (1-eps)/eps^2 with kappa = 5.
  DragValue operator()(double eps, double) const { return {10 * std::max(1 - eps, 0.0) / (eps * eps), 0}; }
  [[nodiscard]] bool outside(double eps, double re) const { return eps > 0.54 || re > 1; }
};

}  // namespace polybed::closures
