// The drag law in the thesis: Cello, Di Renzo and Di Maio, T(4.1)-(4.2), one size, fitted to lattice-Boltzmann data.
//
//   f  = K1 + K2 eps^4 + K3 (1 - eps^4),   K0 = (1-eps)/(1+3 eps)
//   K1 = (1 + 128 K0 + 715 K0^2) / (eps^2 (1 + 49.5 K0))
//   K2 = (1 + 0.13 Re + 6.66e-4 Re^2) / (1 + 3.42e-2 Re + 6.92e-6 Re^2) - 1
//   K3 = 2 Re^2/(1+Re) (-410 eps + 9.2e7 Re K0^20 + 1900 eps^2 - 0.066 Re)
//                    / (6600 eps + 4.92e-4 Re - 43000 eps^2 - 1.31e-4 Re^2 + 7.38e4 eps^3)
//
// The last constant is 7.38e4 (printed 0.0738): only this value reproduces the thesis's own tables.
//
// The bare formula has a pole in Re, above which f < 0, and diverges below eps 0.33. The guard continues it:
//   G1  eps >= 0.35, Re <= Re_c:  the formula;   Re_c = min(1050, 0.5463 Re_s), Re_s the pole
//   G2  eps >= 0.35, Re > Re_c:   f_c T/T_c + (f'_c - f_c T'_c/T_c)(Re - Re_c)(Re_c/Re)^3, T: Turton-Levenspiel
//   G3  eps < 0.35:               K1(eps) + [f(0.35, Re) - K1(0.35)] (0.35/eps)^2, eps at least 0.10
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "closures/drag_turton_levenspiel.hpp"

namespace polybed::closures {

/// The constants of the form, in the order of the formula, and the voidage at which Omega_j = y_j, T(4.28); all
/// positive.
struct CelloConstants {
  double k1_linear = 128, k1_square = 715, k1_below = 49.5;
  double k2_linear = 0.13, k2_square = 6.66e-4, k2_below_linear = 3.42e-2, k2_below_square = 6.92e-6;
  double k3_voidage = 410, k3_dense = 9.2e7, k3_voidage_square = 1900, k3_reynolds = 0.066;
  double pole_voidage = 6600, pole_reynolds = 4.92e-4, pole_voidage_square = 43000;
  double pole_reynolds_square = 1.31e-4, pole_voidage_cube = 7.38e4, crossing = 0.73;
};

/// The constants in the thesis, known at compile time.
struct PublishedCello {
  static constexpr std::string_view name = "cello";
  static constexpr std::string_view help = "mixtures, fitted to resolved flow; voidage 0.35-1, Re <= 1050";
  static constexpr std::string_view source =
      "Cello, Di Renzo and Di Maio 2010; Cello 2009, eqs. 4.1-4.2, on lattice-Boltzmann data";
  static constexpr CelloConstants constants{};
};

/// Constants from a file: see closures/drag_form.hpp.
struct FittedCello {
  static constexpr std::string_view name = "fitted cello", help = "the form of cello with constants of a file";
  static constexpr std::string_view source = "";
  static constexpr bool is_fitted = true;
  CelloConstants constants = {};
};

template <class Source>
struct CelloForm : Source {
  static constexpr double least_voidage = 0.35;  ///< least in the data; guard G3 applies below
  Guard guard = Guard::on;

  DragValue operator()(double eps, double re) const {
    return guard == Guard::on && outside(eps, re) ? guarded(std::min(eps, 1.0), re) : bare(eps, re);
  }

  /// Whether the guard applies: outside the data, or too near the pole.
  [[nodiscard]] bool outside(double eps, double re) const {
    return eps < least_voidage || eps > 1 || re > most_reynolds(eps);
  }

  /// Whether outside() is false without its square root: Re_c is at least 687 within the data.
  [[nodiscard]] bool surely_inside(double eps, double re) const {
    if constexpr (requires { Source::is_fitted; }) return !outside(eps, re);
    return (eps >= least_voidage) & (eps <= 1) & (re <= 600);
  }

  /// The published formula, branch-free. Divisions dominate the cost: each denominator is inverted once.
  [[nodiscard]] DragValue bare(double eps, double re) const {
    const CelloConstants& k = this->constants;
    const double eps2 = eps * eps, eps4 = eps2 * eps2;
    const double k0 = (1 - eps) / (1 + 3 * eps);
    const double up2 = 1 + re * (k.k2_linear + k.k2_square * re);
    const double per_down2 = 1 / (1 + re * (k.k2_below_linear + k.k2_below_square * re));
    const double ratio2 = up2 * per_down2;
    const double d2 = re *
                      (k.k2_linear + 2 * k.k2_square * re - ratio2 * (k.k2_below_linear + 2 * k.k2_below_square * re)) *
                      per_down2;
    const double k2 = k0 * k0, k4 = k2 * k2, k8 = k4 * k4, k20 = k8 * k8 * k4;
    const double linear = k.k3_dense * k20 - k.k3_reynolds;
    const double up3 = eps * (-k.k3_voidage + k.k3_voidage_square * eps) + linear * re;
    const double per_down3 = 1 / (pole_constant(eps) + re * (k.pole_reynolds - k.pole_reynolds_square * re)),
                 ratio3 = up3 * per_down3;
    const double per_re1 = 1 / (1 + re), front = 2 * re * re * per_re1, k3 = front * ratio3;
    // Re dK3/dRe = K3 (Re front'/front) + front (Re up' - up3 Re down'/down3) / down3
    const double d3 = k3 * (2 + re) * per_re1 +
                      front * re * (linear - ratio3 * (k.pole_reynolds - 2 * k.pole_reynolds_square * re)) * per_down3;
    const double f = creeping(eps) + (ratio2 - 1) * eps4 + k3 * (1 - eps4);
    return {f, d2 * eps4 + d3 * (1 - eps4)};
  }

  /// K1, the limit Re -> 0.
  [[nodiscard]] double creeping(double eps) const {
    const CelloConstants& k = this->constants;
    const double k0 = (1 - eps) / (1 + 3 * eps);
    return (1 + k0 * (k.k1_linear + k.k1_square * k0)) / (eps * eps * (1 + k.k1_below * k0));
  }

  /// Re_c: the formula is used up to here.
  [[nodiscard]] double most_reynolds(double eps) const {
    const double a = this->constants.pole_reynolds_square, b = this->constants.pole_reynolds;
    const double pole = (b + std::sqrt(std::max(b * b + 4 * a * pole_constant(eps), 0.0))) / (2 * a);
    return std::min(1050.0, 0.5463 * pole);
  }

 private:
  [[nodiscard]] double pole_constant(double eps) const {
    const CelloConstants& k = this->constants;
    return eps * (k.pole_voidage + eps * (-k.pole_voidage_square + k.pole_voidage_cube * eps));
  }

  [[nodiscard]] DragValue guarded(double eps, double re) const {
    if (eps >= least_voidage) return beyond_data(eps, re);
    const double low = std::max(eps, 0.10), scale = (least_voidage / low) * (least_voidage / low);
    const DragValue edge = beyond_data(least_voidage, re);
    return {creeping(low) + (edge.f - creeping(least_voidage)) * scale, edge.re_dfdre * scale};
  }

  /// G1 and G2 at a voidage within the data.
  [[nodiscard]] DragValue beyond_data(double eps, double re) const {
    const double re_c = most_reynolds(eps);
    if (re <= re_c) return bare(eps, re);
    const DragValue at_c = bare(eps, re_c), t_c = DragTurtonLevenspiel{}(1, re_c), t = DragTurtonLevenspiel{}(1, re);
    const double mismatch = (at_c.re_dfdre - at_c.f * t_c.re_dfdre / t_c.f) / re_c;
    const double ratio = re_c / re, fade = (re - re_c) * ratio * ratio * ratio;
    return {at_c.f * t.f / t_c.f + mismatch * fade,
            at_c.f * t.re_dfdre / t_c.f + mismatch * (re * ratio * ratio * ratio - 3 * fade)};
  }
};

using DragCello = CelloForm<PublishedCello>;
using DragFittedCello = CelloForm<FittedCello>;

}  // namespace polybed::closures
