// Lattice-Boltzmann law of Van der Hoef, Beetstra and Kuipers 2005, 2007, T(3.32).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "closures/drag_value.hpp"
#include "closures/elementary.hpp"

namespace polybed::closures {

struct DragVbk {
  static constexpr std::string_view name = "vbk";
  static constexpr std::string_view help = "fitted to resolved flow; voidage 0.40-0.90, Re < 1050";
  static constexpr std::string_view source =
      "Van der Hoef, Beetstra and Kuipers 2005 and 2007, lattice-Boltzmann; Cello 2009, eq. 3.32";
  Guard guard = Guard::on;
  /// f = 10 phi/eps^2 + eps^2 (1 + 1.5 sqrt phi)
  ///     + (0.413 Re/(24 eps^2)) (1/eps + 3 eps phi + 8.4 Re^-0.343)/(1 + 10^(3 phi) Re^(-0.5-2 phi)); last
  ///     term 0 at Re 0.
  DragValue operator()(double eps, double re) const {
    const double phi = std::max(1 - eps, 0.0), per_eps2 = 1 / (eps * eps);
    const double creeping = 10 * phi * per_eps2 + eps * eps * (1 + 1.5 * std::sqrt(phi));
    const double log_re = plain_log(std::max(re, 1e-100));  // below, the last term is under 1e-100
    const double power = 8.4 * plain_exp(-0.343 * log_re);
    const double above = 1 / eps + 3 * eps * phi + power;
    // 1/(1 + 10^(3 phi) Re^(-m)) as q/(1 + q), q = 10^(-3 phi) Re^m, which cannot overflow at small Re.
    const double exponent = 0.5 + 2 * phi;
    const double q = plain_exp(exponent * log_re - 3 * phi * std::numbers::ln10);
    const double inertia = 0.413 / 24 * re * per_eps2 * above * q / (1 + q);
    return {creeping + inertia, inertia * (1 - 0.343 * power / above + exponent / (1 + q))};
  }
  [[nodiscard]] bool outside(double eps, double re) const { return eps < 0.40 || eps > 0.90 || re > 1050; }
};

}  // namespace polybed::closures
