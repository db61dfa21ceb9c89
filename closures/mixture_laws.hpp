// The mixture drag laws, each as f_j = offset_j + factor_j f_base(eps_j, Re_j): see MixtureTerms.
//
// Each struct has the base law, coefficient(eps, composition), computed once per cell, and term(cell, diameter, share)
// for one species; both are pure, and preferably branch-free, so that loops over cells are vectorised. The sum rule sum
// x_j f_j / y_j^2 = f_mean, T(3.45), gives the right pressure drop; obeys_sum_rule marks the laws that satisfy it. A
// law with `shares` can also distribute another mean law's drag among the species: see Partition.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "closures/drag_cello.hpp"
#include "closures/drag_gidaspow.hpp"
#include "closures/drag_vbk.hpp"
#include "closures/mixture.hpp"

namespace polybed::closures {

/// A law not of this form: it computes a medium for each cell, an array of numbers, then f_j of each species in it.
template <class Law>
concept HasMedium = requires {
  typename Law::Medium;
};

/// The cell as input to the law: its composition, and the law's coefficient.
template <class Law>
[[nodiscard]] MixtureCell mixture_cell(const Law& law, double eps, const Composition& composition) {
  return {eps, 1 / composition.per_mean, composition.per_mean, law.coefficient(eps, composition)};
}

/// Omega_j = y_j [1 + h(eps)(y_j - 1)/y_m], T(4.18)-(4.21), (4.28), with a mean law.
template <class Mean>
struct CelloShares {
  static constexpr std::string_view name = "cello", help = DragCello::help, source = DragCello::source;
  static constexpr std::string_view shares = "by diameter and voidage, fitted to resolved flow";
  static constexpr std::string_view shares_source =
      "Omega_j = y_j [1 + h (y_j - 1)/y_m], h by voidage; Cello, Di Renzo and Di Maio 2010; Cello 2009, eqs. "
      "4.18-4.21, 4.28";
  static constexpr bool obeys_sum_rule = true;
  static constexpr bool mean_is_base = true;
  using Base = Mean;
  Base base;
  /// 1 - gamma: the base law's if it has one.
  [[nodiscard]] double crossing() const {
    if constexpr (requires { base.constants.crossing; }) return base.constants.crossing;
    return PublishedCello::constants.crossing;
  }
  /// h/y_m.
  [[nodiscard]] double coefficient(double eps, const Composition& c) const {
    const double y_m = c.average * c.per_mean, y_max = c.largest * c.per_mean;
    return (base.guard == Guard::on ? cello_h_guarded(std::min(eps, 1.0), y_max, y_m, crossing())
                                    : cello_h(eps, crossing())) /
           y_m;
  }
  [[nodiscard]] MixtureTerms term(const MixtureCell& cell, double diameter, double) const {
    const double y = diameter * cell.per_mean;
    return {cell.voidage, cell.mean, 0, y * (1 + cell.coefficient * (y - 1))};
  }
};

using MixtureCello = CelloShares<DragCello>;
using MixtureFittedCello = CelloShares<DragFittedCello>;

/// Omega_j = y_j, T(3.53).
template <class Mean>
struct VbkTheoryShares {
  static constexpr std::string_view name = "vbk_theory", help = "vbk for mixtures, shared by diameter alone";
  static constexpr std::string_view source =
      "vbk with Omega_j = y_j; Van der Hoef, Beetstra and Kuipers 2005; Cello 2009, eq. 3.53";
  static constexpr std::string_view shares = "by diameter alone";
  static constexpr std::string_view shares_source =
      "Omega_j = y_j; Van der Hoef, Beetstra and Kuipers 2005; Cello 2009, eq. 3.53";
  static constexpr bool obeys_sum_rule = true;
  static constexpr bool mean_is_base = true;
  using Base = Mean;
  Base base;
  [[nodiscard]] double coefficient(double, const Composition&) const { return 0; }
  [[nodiscard]] MixtureTerms term(const MixtureCell& cell, double diameter, double) const {
    return {cell.voidage, cell.mean, 0, diameter * cell.per_mean};
  }
};

using MixtureVbkTheory = VbkTheoryShares<DragVbk>;

/// Omega_j = y_j + 0.064 y_j^3, T(3.54); voidage 0.35-0.90, y 0.44-2.52.
template <class Mean>
struct VbkCorrectedShares {
  static constexpr std::string_view name = "vbk_corrected", help = "vbk for mixtures, more drag on large particles";
  static constexpr std::string_view source =
      "vbk with Omega_j = y_j + 0.064 y_j^3; Beetstra, Van der Hoef and Kuipers 2007; Cello 2009, eq. 3.54";
  static constexpr std::string_view shares =
      "by diameter, more for large particles; voidage 0.35-0.90, diameter over mean 0.44-2.52";
  static constexpr std::string_view shares_source =
      "Omega_j = y_j + 0.064 y_j^3; Beetstra, Van der Hoef and Kuipers 2007; Cello 2009, eq. 3.54";
  static constexpr bool obeys_sum_rule = false;
  static constexpr bool mean_is_base = true;
  using Base = Mean;
  Base base;
  [[nodiscard]] double coefficient(double, const Composition&) const { return 0; }
  [[nodiscard]] MixtureTerms term(const MixtureCell& cell, double diameter, double) const {
    const double y = diameter * cell.per_mean;
    return {cell.voidage, cell.mean, 0, y + 0.064 * y * y * y};
  }
};

using MixtureVbkCorrected = VbkCorrectedShares<DragVbk>;

/// f_j = 1/eps + (f_mean - 1/eps)[a y_j + (1-a) y_j^2], T(3.55)-(3.56), Yin and Sundaresan 2009; a at phi <= 0.4.
struct MixtureYinSundaresan {
  static constexpr std::string_view name = "yin_sundaresan",
                                    help = "mixtures in creeping flow, on cello; voidage 0.60-0.90";
  static constexpr std::string_view source = "Yin and Sundaresan 2009; Cello 2009, eqs. 3.55-3.56";
  static constexpr std::string_view shares = "by diameter and voidage, creeping flow; voidage 0.60-0.90";
  static constexpr std::string_view shares_source =
      "1/eps + (f_cello - 1/eps)[a y_j + (1-a) y_j^2] over f_cello; Yin and Sundaresan 2009; Cello 2009, eqs. "
      "3.55-3.56";
  static constexpr bool obeys_sum_rule = false;
  static constexpr bool mean_is_base = true;
  using Base = DragCello;
  Base base;
  /// a.
  [[nodiscard]] double coefficient(double eps, const Composition&) const {
    const double phi = base.guard == Guard::on ? std::clamp(1 - eps, 0.0, 0.4) : 1 - eps;
    return 1 + phi * (-2.660 + phi * (9.096 - 11.33 * phi));
  }
  [[nodiscard]] MixtureTerms term(const MixtureCell& cell, double diameter, double) const {
    const double y = diameter * cell.per_mean, a = cell.coefficient, weight = a * y + (1 - a) * y * y;
    return {cell.voidage, cell.mean, (1 - weight) / cell.voidage, weight};
  }
};

/// f_j = cello(eps_j, Re_j), eps_j = 1 - (1 + delta/D_j)^-3, delta = [(1-eps)^(-1/3) - 1] sum x_k D_k, T(3.34)-(3.36),
/// Patwardhan and Tien 1985.
struct MixturePatwardhanTien {
  static constexpr std::string_view name = "patwardhan_tien", help = "mixtures, with a voidage for each species";
  static constexpr std::string_view source = "Patwardhan and Tien 1985; Cello 2009, eqs. 3.34-3.36";
  static constexpr bool obeys_sum_rule = false;
  static constexpr bool mean_is_base = false;
  using Base = DragCello;
  Base base;
  /// delta, m; infinite at eps >= 1, which makes eps_j 1. mean_diameter: sum x_k D_k, m.
  [[nodiscard]] static double half_gap(double eps, double mean_diameter) {
    return mean_diameter * (1 / std::cbrt(std::max(1 - eps, 0.0)) - 1);
  }
  /// eps_j for one species in a shell of thickness delta.
  [[nodiscard]] static double voidage_around(double diameter, double gap) {
    const double ratio = 1 + gap / diameter;
    return 1 - 1 / (ratio * ratio * ratio);
  }
  /// eps_j for one species.
  [[nodiscard]] static double own_voidage(double eps, double diameter, double mean_diameter) {
    return voidage_around(diameter, half_gap(eps, mean_diameter));
  }
  [[nodiscard]] double coefficient(double eps, const Composition& c) const { return half_gap(eps, c.average); }
  [[nodiscard]] MixtureTerms term(const MixtureCell& cell, double diameter, double) const {
    return {voidage_around(diameter, cell.coefficient), diameter, 0, 1};
  }
};

/// f_j = x_j f_gidaspow(eps, Re), T(3.37), Syamlal 1985; for comparison only: it violates the sum rule.
struct MixtureSyamlal {
  static constexpr std::string_view name = "syamlal", help = "gidaspow times the share of the species; for comparison";
  static constexpr std::string_view source = "Syamlal 1985; Cello 2009, eq. 3.37";
  static constexpr bool obeys_sum_rule = false;
  static constexpr bool mean_is_base = true;
  using Base = DragGidaspow;
  Base base;
  [[nodiscard]] double coefficient(double, const Composition&) const { return 0; }
  [[nodiscard]] MixtureTerms term(const MixtureCell& cell, double, double share) const {
    return {cell.voidage, cell.mean, 0, share};
  }
};

/// A law of one size used for a mixture: it acts on each species with its own Re_j, as in T(5.13).
template <class Law>
struct EachSpecies {
  static constexpr std::string_view name = Law::name, help = Law::help, source = Law::source;
  static constexpr bool obeys_sum_rule = false;
  static constexpr bool mean_is_base = false;
  using Base = Law;
  Base base;
  [[nodiscard]] double coefficient(double, const Composition&) const { return 0; }
  [[nodiscard]] MixtureTerms term(const MixtureCell& cell, double diameter, double) const {
    return {cell.voidage, diameter, 0, 1};
  }
};

}  // namespace polybed::closures
