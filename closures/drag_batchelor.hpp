// Dilute creeping suspensions, Batchelor 1972, T(3.22).
#pragma once

#include <string_view>

#include "closures/drag_value.hpp"

namespace polybed::closures {

struct DragBatchelor {
  static constexpr std::string_view name = "batchelor";
  static constexpr std::string_view help = "dilute suspension, creeping flow: Re < 0.1; solids fraction < 0.05";
  static constexpr std::string_view source = "Batchelor 1972; Cello 2009, eq. 3.22";
  Guard guard = Guard::on;
  /// f = eps/(1 - 6.55 phi), singular at eps 0.8473; the guard uses its tangent beyond phi = 0.05.
  DragValue operator()(double eps, double) const {
    const double phi = 1 - eps;
    if (guard == Guard::on && phi > 0.05) return {1.41264 + 12.2718 * (phi - 0.05), 0};
    return {eps / (1 - 6.55 * phi), 0};
  }
  [[nodiscard]] bool outside(double eps, double re) const { return eps < 0.95 || re > 0.1; }
};

}  // namespace polybed::closures
