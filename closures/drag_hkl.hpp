// Lattice-Boltzmann law of Hill, Koch and Ladd 2001, T(3.31), linear branch.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "closures/drag_value.hpp"
#include "closures/elementary.hpp"

namespace polybed::closures {

struct DragHkl {
  static constexpr std::string_view name = "hkl";
  static constexpr std::string_view help = "fitted to resolved flow; voidage > 0.36, Re < 150";
  static constexpr std::string_view source = "Hill, Koch and Ladd 2001, lattice-Boltzmann; Cello 2009, eq. 3.31";
  Guard guard = Guard::on;
  /// f = f_0 + f_3 Re/2. The cubic's sign is -8.48 (printed +8.48). f_0 jumps by 1 % at phi 0.4; the guard
  /// blends its branches over 0.38-0.40.
  DragValue operator()(double eps, double re) const {
    const double phi = std::max(1 - eps, 0.0);
    const double inertia = 0.5 * re * slope(phi);
    return {creeping(phi) + inertia, inertia};
  }
  [[nodiscard]] bool outside(double eps, double re) const { return eps < 0.36 || re > 150; }

 private:
  [[nodiscard]] static double slope(double phi) {
    const double eps = 1 - phi, eps5 = eps * eps * eps * eps * eps;
    return eps * (0.0673 + 0.212 * phi + 0.0232 / eps5);
  }
  [[nodiscard]] static double dense(double phi) { return 10 * phi / ((1 - phi) * (1 - phi)); }
  [[nodiscard]] static double dilute(double phi) {
    const double logarithm = phi * plain_log(std::max(phi, 1e-300));
    return (1 - phi) * (1 + 3 / std::sqrt(2.0) * std::sqrt(phi) + 135.0 / 64 * logarithm + 16.14 * phi) /
           (1 + phi * (0.681 + phi * (-8.48 + 8.16 * phi)));
  }
  [[nodiscard]] double creeping(double phi) const {
    const double least = guard == Guard::on ? 0.38 : 0.4, share = phi >= 0.4 ? 1 : std::max((phi - least) / 0.02, 0.0);
    return (1 - share) * dilute(phi) + share * dense(phi);
  }
};

}  // namespace polybed::closures
