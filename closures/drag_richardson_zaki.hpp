// Homogeneous expansion, Richardson and Zaki 1954, T(3.26)-(3.28).
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "closures/drag_turton_levenspiel.hpp"

namespace polybed::closures {

struct DragRichardsonZaki {
  static constexpr std::string_view name = "richardson_zaki";
  static constexpr std::string_view help = "evenly expanded bed of any voidage, on turton_levenspiel";
  static constexpr std::string_view source = "Cello 2009, eqs. 3.26-3.28";
  Guard guard = Guard::on;

  /// Exponent q(Re_t), T(3.28): 4.65 to 0.2; 4.45 Re_t^-0.1 for 1-500; 2.39 above; linear in log Re_t from
  /// 0.2 to 1 (bare: 4.35 Re_t^-0.03 there, with jumps of 2 %).
  [[nodiscard]] double exponent(double re_t) const {
    if (re_t <= 0.2) return 4.65;
    if (re_t < 1)
      return guard == Guard::on ? 4.65 + (4.45 - 4.65) * std::log(re_t / 0.2) / std::log(5.0)
                                : 4.35 * std::pow(re_t, -0.03);
    return re_t <= 500 ? 4.45 * std::pow(re_t, -0.1) : 2.39;
  }

  /// f = eps^(1-q) T(Re_t) with Re_t eps^q(Re_t) = Re; the root is unique for eps > 0.
  DragValue operator()(double eps, double re) const {
    const double voidage = std::min(eps, 1.0);
    if (!(re > 0)) return {std::pow(voidage, 1 - 4.65), 0};
    const double log_re_t = terminal(voidage, std::log(re));
    const double re_t = std::exp(log_re_t), q = exponent(re_t);
    const DragValue t = DragTurtonLevenspiel{}(1, re_t);
    const double f = std::pow(voidage, 1 - q) * t.f;
    // d ln Re_t / d ln Re = 1/(1 + ln(eps) dq/dlnRe_t);  d ln f = (-ln(eps) dq + dlnT) d ln Re_t
    const double q_slope = exponent_slope(re_t), log_eps = std::log(voidage);
    return {f, f * (t.re_dfdre / t.f - log_eps * q_slope) / (1 + log_eps * q_slope)};
  }
  [[nodiscard]] bool outside(double eps, double) const { return eps < 0.4; }

 private:
  [[nodiscard]] double exponent_slope(double re_t) const {
    if (re_t <= 0.2) return 0;
    if (re_t < 1) return guard == Guard::on ? -0.2 / std::log(5.0) : -0.03 * exponent(re_t);
    return re_t <= 500 ? -0.1 * exponent(re_t) : 0;
  }
  /// Solves ln Re_t + q(Re_t) ln eps = ln Re. The left side grows with Re_t, so each range of q is tried in turn.
  [[nodiscard]] double terminal(double eps, double log_re) const {
    const double log_eps = std::log(eps);
    if (guard != Guard::on) return bisected(log_eps, log_re);
    const double slope = -0.2 / std::log(5.0), first = std::log(0.2), last = std::log(500.0);
    const double slow = log_re - 4.65 * log_eps, fast = log_re - 2.39 * log_eps;
    if (slow <= first) return slow;
    const double between = (slow + slope * log_eps * first) / (1 + slope * log_eps);
    if (between < 0) return between;
    return fast > last ? fast : by_newton(log_eps, log_re, std::max(fast, 0.0), last);
  }
  /// The root where q = 4.45 Re_t^-0.1. The function is concave, so Newton steps after the first approach from one
  /// side.
  [[nodiscard]] static double by_newton(double log_eps, double log_re, double start, double last) {
    double root = start;
    for (int n = 0; n < 30; ++n) {
      const double q = 4.45 * std::exp(-0.1 * root), step = (root + q * log_eps - log_re) / (1 - 0.1 * q * log_eps);
      root -= step;
      if (std::abs(step) <= 4e-16 * std::max(1.0, std::abs(root))) break;
    }
    return std::min(root, last);
  }
  /// The same for an exponent with jumps.
  [[nodiscard]] double bisected(double log_eps, double log_re) const {
    double low = log_re, high = log_re - 4.65 * log_eps + 1e-12;
    for (int n = 0; n < 200 && high - low > 1e-15 * std::max(1.0, std::abs(high)); ++n) {
      const double middle = 0.5 * (low + high);
      (middle + exponent(std::exp(middle)) * log_eps < log_re ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
};

}  // namespace polybed::closures
