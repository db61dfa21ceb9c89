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
  static constexpr std::string_view source = "Richardson and Zaki 1954; Cello 2009, eqs. 3.26-3.28";
  Guard guard = Guard::on;

  /// Exponent q(Re_t), T(3.28): 4.65 to 0.2; 4.45 Re_t^-0.1 for 1-500; 2.39 above; linear in log Re_t from
  /// 0.2 to 1 (bare: 4.35 Re_t^-0.03 there, with jumps of 2 %).
  [[nodiscard]] double exponent(double re_t) const { return power_at(std::log(re_t), guard).q; }

  /// f = eps^(1-q) T(Re_t) with Re_t eps^q(Re_t) = Re; the root is unique for eps > 0.
  DragValue operator()(double eps, double re) const {
    if (guard == Guard::on) return guarded(eps, re);
    const double log_eps = log_voidage(eps), log_re_t = bisected(log_eps, log_reynolds(re));
    return drag_at(log_eps, log_re_t, power_at(log_re_t, Guard::off));
  }
  /// The same with the guard on, without branches.
  [[nodiscard]] DragValue guarded(double eps, double re) const {
    const double log_eps = log_voidage(eps), log_re_t = terminal(log_eps, log_reynolds(re));
    return drag_at(log_eps, log_re_t, power_at(log_re_t, Guard::on));
  }
  [[nodiscard]] bool outside(double eps, double) const { return eps < 0.4; }

 private:
  static constexpr double first = -1.6094379124341003, last = 6.214608098422191;  // ln 0.2, ln 500
  static constexpr double slope = (4.65 - 4.45) / first;                          // dq/dlnRe_t between 0.2 and 1

  struct Power {
    double q, slope;  // dq/dlnRe_t
  };
  [[nodiscard]] static double log_voidage(double eps) { return plain_log(std::clamp(eps, 1e-60, 1.0)); }
  [[nodiscard]] static double log_reynolds(double re) { return plain_log(std::max(re, 1e-60)); }

  [[nodiscard]] static Power power_at(double log_re_t, Guard guard) {
    const double fast = 4.45 * plain_exp(-0.1 * std::clamp(log_re_t, 0.0, last));
    const double bare = 4.35 * plain_exp(-0.03 * std::clamp(log_re_t, first, 0.0));
    const bool on = guard == Guard::on;
    const double q = log_re_t < 0 ? (on ? 4.45 + slope * log_re_t : bare) : log_re_t > last ? 2.39 : fast;
    const double q_slope = log_re_t < 0 ? (on ? slope : -0.03 * bare) : log_re_t > last ? 0 : -0.1 * fast;
    return {log_re_t <= first ? 4.65 : q, log_re_t <= first ? 0 : q_slope};
  }
  [[nodiscard]] static DragValue drag_at(double log_eps, double log_re_t, Power power) {
    const auto [q, q_slope] = power;
    const DragValue t = DragTurtonLevenspiel{}(1, plain_exp(log_re_t));
    const double f = plain_exp((1 - q) * log_eps) * t.f;
    // d ln Re_t / d ln Re = 1/(1 + ln(eps) dq/dlnRe_t);  d ln f = (-ln(eps) dq + dlnT) d ln Re_t
    return {f, f * (t.re_dfdre / t.f - log_eps * q_slope) / (1 + log_eps * q_slope)};
  }
  /// Solves ln Re_t + q(Re_t) ln eps = ln Re. The left side grows with Re_t, so the first range that has its root
  /// counts.
  [[nodiscard]] static double terminal(double log_eps, double log_re) {
    const double slow = log_re - 4.65 * log_eps, fast = log_re - 2.39 * log_eps;
    const double between = (slow + slope * log_eps * first) / (1 + slope * log_eps);
    const double above = fast > last ? fast : std::min(between_1_and_500(log_eps, log_re), last);
    return slow <= first ? slow : between < 0 ? between : above;
  }
  /// The root where q = 4.45 Re_t^-0.1, ln Re_t = ln Re + 10 w with w e^w = -0.445 ln(eps) Re^-0.1: three steps of
  /// Halley's method from a Pade approximation, to round-off for eps > 0.01.
  [[nodiscard]] static double between_1_and_500(double log_eps, double log_re) {
    const double a = -0.445 * log_eps * plain_exp(-0.1 * std::clamp(log_re, -25.0, last));
    double w = a * (1 + 4.0 / 3 * a) / (1 + a * (7.0 / 3 + 5.0 / 6 * a));
    for (int n = 0; n < 3; ++n) {
      const double grown = plain_exp(w), miss = w * grown - a;
      w -= 2 * (w + 1) * miss / (2 * (w + 1) * (w + 1) * grown - (w + 2) * miss);
    }
    return log_re + 10 * w;
  }
  /// The root for an exponent with jumps.
  [[nodiscard]] static double bisected(double log_eps, double log_re) {
    double low = log_re, high = log_re - 4.65 * log_eps + 1e-12;
    for (int n = 0; n < 200 && high - low > 1e-15 * std::max(1.0, std::abs(high)); ++n) {
      const double middle = 0.5 * (low + high);
      (middle + power_at(middle, Guard::off).q * log_eps < log_re ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
};

}  // namespace polybed::closures
