// The drag laws of mixtures, each as f_j = offset_j + factor_j f_base(eps_j, Re_j): see MixtureTerms.
//
// Each struct has the base law, and terms(eps, share, diameter, out) for all species of a cell. The sum rule
// sum x_j f_j / y_j^2 = f_mean, T(3.45), is what gives the right pressure drop; obeys_sum_rule says who keeps it.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "closures/drag_cello.hpp"
#include "closures/drag_gidaspow.hpp"
#include "closures/drag_vbk.hpp"
#include "closures/mixture.hpp"

namespace polybed::closures {

using Shares = std::span<const double>;
using Diameters = std::span<const double>;

/// Omega_j = y_j [1 + h(eps)(y_j - 1)/y_m], T(4.18)-(4.21), (4.28).
struct MixtureCello {
  static constexpr std::string_view name = "cello", help = DragCello::help;
  static constexpr bool obeys_sum_rule = true;
  static constexpr bool mean_is_base = true;
  using Base = DragCello;
  Base base;
  void terms(double eps, Shares share, Diameters diameter, std::span<MixtureTerms> out) const {
    const double mean = sauter_diameter(share, diameter), y_m = poly_index_mean(share, diameter);
    const double y_max = *std::max_element(diameter.begin(), diameter.end()) / mean;
    const double h = base.guard == Guard::on ? cello_h_guarded(std::min(eps, 1.0), y_max, y_m) : cello_h(eps);
    for (std::size_t j = 0; j < diameter.size(); ++j) {
      const double y = diameter[j] / mean;
      out[j] = {eps, mean, 0, y * (1 + h * (y - 1) / y_m)};
    }
  }
};

/// Omega_j = y_j, T(3.53).
struct MixtureVbkTheory {
  static constexpr std::string_view name = "vbk_theory", help = "vbk with Omega_j = y_j; T(3.53)";
  static constexpr bool obeys_sum_rule = true;
  static constexpr bool mean_is_base = true;
  using Base = DragVbk;
  Base base;
  void terms(double eps, Shares share, Diameters diameter, std::span<MixtureTerms> out) const {
    const double mean = sauter_diameter(share, diameter);
    for (std::size_t j = 0; j < diameter.size(); ++j) out[j] = {eps, mean, 0, diameter[j] / mean};
  }
};

/// Omega_j = y_j + 0.064 y_j^3, T(3.54); voidage 0.35-0.90, y 0.44-2.52.
struct MixtureVbkCorrected {
  static constexpr std::string_view name = "vbk_corrected", help = "vbk with Omega_j = y_j + 0.064 y_j^3; T(3.54)";
  static constexpr bool obeys_sum_rule = false;
  static constexpr bool mean_is_base = true;
  using Base = DragVbk;
  Base base;
  void terms(double eps, Shares share, Diameters diameter, std::span<MixtureTerms> out) const {
    const double mean = sauter_diameter(share, diameter);
    for (std::size_t j = 0; j < diameter.size(); ++j) {
      const double y = diameter[j] / mean;
      out[j] = {eps, mean, 0, y + 0.064 * y * y * y};
    }
  }
};

/// f_j = 1/eps + (f_mean - 1/eps)[a y_j + (1-a) y_j^2], T(3.55)-(3.56), Yin and Sundaresan 2009; a at phi <= 0.4.
struct MixtureYinSundaresan {
  static constexpr std::string_view name = "yin_sundaresan",
                                    help =
                                        "Yin and Sundaresan 2009 on cello; T(3.55)-(3.56), Re -> 0, voidage 0.60-0.90";
  static constexpr bool obeys_sum_rule = false;
  static constexpr bool mean_is_base = true;
  using Base = DragCello;
  Base base;
  void terms(double eps, Shares share, Diameters diameter, std::span<MixtureTerms> out) const {
    const double mean = sauter_diameter(share, diameter),
                 phi = base.guard == Guard::on ? std::clamp(1 - eps, 0.0, 0.4) : 1 - eps;
    const double a = 1 + phi * (-2.660 + phi * (9.096 - 11.33 * phi));
    for (std::size_t j = 0; j < diameter.size(); ++j) {
      const double y = diameter[j] / mean, weight = a * y + (1 - a) * y * y;
      out[j] = {eps, mean, (1 - weight) / eps, weight};
    }
  }
};

/// f_j = cello(eps_j, Re_j), eps_j = 1 - (1 + delta/D_j)^-3, T(3.34)-(3.36), Patwardhan and Tien 1985.
struct MixturePatwardhanTien {
  static constexpr std::string_view name = "patwardhan_tien",
                                    help = "a voidage for each species, Patwardhan and Tien 1985; T(3.34)-(3.36)";
  static constexpr bool obeys_sum_rule = false;
  static constexpr bool mean_is_base = false;
  using Base = DragCello;
  Base base;
  /// eps_j of one species; 1 at eps >= 1. mean_diameter: sum x_k D_k, m.
  [[nodiscard]] static double own_voidage(double eps, double diameter, double mean_diameter) {
    if (eps >= 1) return 1;
    const double ratio = 1 + mean_diameter * (1 / std::cbrt(1 - eps) - 1) / diameter;
    return 1 - 1 / (ratio * ratio * ratio);
  }
  void terms(double eps, Shares share, Diameters diameter, std::span<MixtureTerms> out) const {
    double average = 0;
    for (std::size_t k = 0; k < diameter.size(); ++k) average += share[k] * diameter[k];
    for (std::size_t j = 0; j < diameter.size(); ++j)
      out[j] = {own_voidage(eps, diameter[j], average), diameter[j], 0, 1};
  }
};

/// f_j = x_j f_gidaspow(eps, Re), T(3.37), Syamlal 1985; for comparison only: it breaks the sum rule.
struct MixtureSyamlal {
  static constexpr std::string_view name = "syamlal",
                                    help = "x_j times gidaspow, Syamlal 1985; T(3.37), for comparison";
  static constexpr bool obeys_sum_rule = false;
  static constexpr bool mean_is_base = true;
  using Base = DragGidaspow;
  Base base;
  void terms(double eps, Shares share, Diameters diameter, std::span<MixtureTerms> out) const {
    const double mean = sauter_diameter(share, diameter);
    for (std::size_t j = 0; j < diameter.size(); ++j) out[j] = {eps, mean, 0, share[j]};
  }
};

/// A law of one size named for a mixture: it acts on each species with its own Re_j, as in T(5.13).
template <class Law>
struct EachSpecies {
  static constexpr std::string_view name = Law::name, help = Law::help;
  static constexpr bool obeys_sum_rule = false;
  static constexpr bool mean_is_base = false;
  using Base = Law;
  Base base;
  void terms(double eps, Shares, Diameters diameter, std::span<MixtureTerms> out) const {
    for (std::size_t j = 0; j < diameter.size(); ++j) out[j] = {eps, diameter[j], 0, 1};
  }
};

}  // namespace polybed::closures
