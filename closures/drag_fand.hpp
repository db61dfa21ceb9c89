// Packed bed in three regimes, Fand et al. 1987, T(3.25).
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "closures/drag_value.hpp"

namespace polybed::closures {

struct DragFand {
  static constexpr std::string_view name = "fand";
  static constexpr std::string_view help = "packed bed in three regimes of flow, voidage 0.342-0.360, Re <= 408";
  static constexpr std::string_view source = "Fand, Kim, Lam and Phan 1987; Cello 2009, eq. 3.25";
  Guard guard = Guard::on;
  /// f = [A(1-eps) + B Re]/(18 eps^2). Re < 2.3: A 192.24 (36 kappa, kappa 5.34), B 0; 5-80: 182, 1.92; > 120: 225,
  /// 1.61; linear in Re across the gaps. Bare: A 210 below 2.3, as printed, and std::domain_error in the gaps.
  DragValue operator()(double eps, double re) const {
    const double scale = 1 / (18 * eps * eps), solids = std::max(1 - eps, 0.0);
    const auto regime = [&](double a, double b, double r) { return scale * (a * solids + b * r); };
    const auto between = [&](double r0, double f0, double r1, double f1) {
      const double slope = (f1 - f0) / (r1 - r0);
      return DragValue{f0 + slope * (re - r0), slope * re};
    };
    if (re < 2.3) return {regime(guard == Guard::on ? 192.24 : 210, 0, re), 0};
    if (re < 5) {
      refuse_gap();
      return between(2.3, regime(192.24, 0, 2.3), 5, regime(182, 1.92, 5));
    }
    if (re <= 80) return {regime(182, 1.92, re), scale * 1.92 * re};
    if (re <= 120) {
      refuse_gap();
      return between(80, regime(182, 1.92, 80), 120, regime(225, 1.61, 120));
    }
    return {regime(225, 1.61, re), scale * 1.61 * re};
  }
  [[nodiscard]] bool outside(double eps, double re) const { return eps < 0.342 || eps > 0.360 || re > 408; }

 private:
  void refuse_gap() const {
    if (guard == Guard::off) throw std::domain_error("fand: no bare formula between Re 2.3 and 5, and 80 and 120");
  }
};

}  // namespace polybed::closures
