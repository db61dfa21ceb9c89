// Stokes' law, T(3.18).
#pragma once

#include <string_view>

#include "closures/drag_value.hpp"

namespace polybed::closures {

struct DragStokes {
  static constexpr std::string_view name = "stokes";
  static constexpr std::string_view help = "one sphere, creeping flow: Re < 0.1";
  static constexpr std::string_view source = "Stokes 1851; Cello 2009, eq. 3.18";
  Guard guard = Guard::on;
  /// f = 1 at any voidage and Reynolds number.
  DragValue operator()(double, double) const { return {1, 0}; }
  [[nodiscard]] bool outside(double voidage, double re) const { return voidage < 1 || re > 0.1; }
};

}  // namespace polybed::closures
