// The drag law of the thesis: Cello, Di Renzo and Di Maio, T(4.1)-(4.2), one size, regressed on lattice-Boltzmann data.
//
//   f  = K1 + K2 eps^4 + K3 (1 - eps^4),   K0 = (1-eps)/(1+3 eps)
//   K1 = (1 + 128 K0 + 715 K0^2) / (eps^2 (1 + 49.5 K0))
//   K2 = (1 + 0.13 Re + 6.66e-4 Re^2) / (1 + 3.42e-2 Re + 6.92e-6 Re^2) - 1
//   K3 = 2 Re^2/(1+Re) (-410 eps + 9.2e7 Re K0^20 + 1900 eps^2 - 0.066 Re)
//                    / (6600 eps + 4.92e-4 Re - 43000 eps^2 - 1.31e-4 Re^2 + 7.38e4 eps^3)
//
// The last constant is 7.38e4 (printed 0.0738): only so do the thesis's own tables come back.
//
// The bare formula has a pole in Re, behind which f < 0, and explodes below eps 0.33. The guard continues it:
//   G1  eps >= 0.35, Re <= Re_c:  the formula;   Re_c = min(1050, 0.5463 Re_s), Re_s the pole
//   G2  eps >= 0.35, Re > Re_c:   f_c T/T_c + (f'_c - f_c T'_c/T_c)(Re - Re_c)(Re_c/Re)^3, T: Turton-Levenspiel
//   G3  eps < 0.35:               K1(eps) + [f(0.35, Re) - K1(0.35)] (0.35/eps)^2, eps at least 0.10
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "closures/drag_turton_levenspiel.hpp"

namespace polybed::closures {

struct DragCello {
  static constexpr std::string_view name = "cello";
  static constexpr std::string_view help =
      "the thesis's law on lattice-Boltzmann data; T(4.1)-(4.2), voidage 0.35-1, Re <= 1050";
  static constexpr double least_voidage = 0.35;  ///< of the data; below, the guard G3
  Guard guard = Guard::on;

  DragValue operator()(double eps, double re) const {
    return guard == Guard::on && outside(eps, re) ? guarded(std::min(eps, 1.0), re) : bare(eps, re);
  }

  /// Whether the guard answers: outside the data, or too near the pole.
  [[nodiscard]] bool outside(double eps, double re) const {
    return eps < least_voidage || eps > 1 || re > most_reynolds(eps);
  }

  /// Whether outside() is false without its square root: Re_c is at least 687 within the data.
  [[nodiscard]] static bool surely_inside(double eps, double re) {
    return (eps >= least_voidage) & (eps <= 1) & (re <= 600);
  }

  /// The published formula, branch-free. Divisions are what it costs: each denominator is inverted once.
  [[nodiscard]] static DragValue bare(double eps, double re) {
    const double eps2 = eps * eps, eps4 = eps2 * eps2;
    const double k0 = (1 - eps) / (1 + 3 * eps);
    const double up2 = 1 + re * (0.13 + 6.66e-4 * re), per_down2 = 1 / (1 + re * (3.42e-2 + 6.92e-6 * re));
    const double ratio2 = up2 * per_down2;
    const double d2 = re * (0.13 + 2 * 6.66e-4 * re - ratio2 * (3.42e-2 + 2 * 6.92e-6 * re)) * per_down2;
    const double k2 = k0 * k0, k4 = k2 * k2, k8 = k4 * k4, k20 = k8 * k8 * k4;
    const double linear = 9.2e7 * k20 - 0.066, up3 = eps * (-410 + 1900 * eps) + linear * re;
    const double per_down3 = 1 / (pole_constant(eps) + re * (4.92e-4 - 1.31e-4 * re)), ratio3 = up3 * per_down3;
    const double per_re1 = 1 / (1 + re), front = 2 * re * re * per_re1, k3 = front * ratio3;
    // Re dK3/dRe = K3 (Re front'/front) + front (Re up' - up3 Re down'/down3) / down3
    const double d3 =
        k3 * (2 + re) * per_re1 + front * re * (linear - ratio3 * (4.92e-4 - 2 * 1.31e-4 * re)) * per_down3;
    const double f = creeping(eps) + (ratio2 - 1) * eps4 + k3 * (1 - eps4);
    return {f, d2 * eps4 + d3 * (1 - eps4)};
  }

  /// K1, the limit Re -> 0.
  [[nodiscard]] static double creeping(double eps) {
    const double k0 = (1 - eps) / (1 + 3 * eps);
    return (1 + k0 * (128 + 715 * k0)) / (eps * eps * (1 + 49.5 * k0));
  }

  /// Re_c: up to here the formula is used.
  [[nodiscard]] static double most_reynolds(double eps) {
    constexpr double a = 1.31e-4, b = 4.92e-4;
    const double pole = (b + std::sqrt(std::max(b * b + 4 * a * pole_constant(eps), 0.0))) / (2 * a);
    return std::min(1050.0, 0.5463 * pole);
  }

 private:
  [[nodiscard]] static double pole_constant(double eps) { return eps * (6600 + eps * (-43000 + 7.38e4 * eps)); }

  [[nodiscard]] static DragValue guarded(double eps, double re) {
    if (eps >= least_voidage) return beyond_data(eps, re);
    const double low = std::max(eps, 0.10), scale = (least_voidage / low) * (least_voidage / low);
    const DragValue edge = beyond_data(least_voidage, re);
    return {creeping(low) + (edge.f - creeping(least_voidage)) * scale, edge.re_dfdre * scale};
  }

  /// G1 and G2 at a voidage inside the data.
  [[nodiscard]] static DragValue beyond_data(double eps, double re) {
    const double re_c = most_reynolds(eps);
    if (re <= re_c) return bare(eps, re);
    const DragValue at_c = bare(eps, re_c), t_c = DragTurtonLevenspiel{}(1, re_c), t = DragTurtonLevenspiel{}(1, re);
    const double mismatch = (at_c.re_dfdre - at_c.f * t_c.re_dfdre / t_c.f) / re_c;
    const double ratio = re_c / re, fade = (re - re_c) * ratio * ratio * ratio;
    return {at_c.f * t.f / t_c.f + mismatch * fade,
            at_c.f * t.re_dfdre / t_c.f + mismatch * (re * ratio * ratio * ratio - 3 * fade)};
  }
};

}  // namespace polybed::closures
