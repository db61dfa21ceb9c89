// A sphere of one size in a Brinkman medium with Oseen's inertia: this project's drag law, for fixed spheres in any
// mixture of sizes. Seven constants are fitted to the lattice-Boltzmann rows in tests/data/lbm, the rest is theory.
//
//   f0(phi)  = 10 phi/eps^2 + eps^5 [1 + (3/sqrt 2) sqrt phi + (135/64) phi ln phi + 10.456 phi]
//   c(phi)   = phi/(2 eps + 2.664 phi^3)
//   I(phi,R) = (3/16) R {(1 + 0.9095 phi) eps^(-9/4) (1 + 0.7664 R)^(-0.4422 + 0.2509 phi) + 0.04289 (1 + 20.4 phi)}
//   K_j = sqrt(phi + eps m2) y_j [(1-c) f0 - 1/eps] + c f0 y_j^2      viscous, screened (Brinkman); m2 = sum x_k/y_k^2
//   J_j = I(phi, Re_j) [1 + (3/2) c (y_j - 1)]                        inertial (Oseen, then Forchheimer)
//   f_j = 1/eps + (K_j^(3/2) + J_j^(3/2))^(2/3)
//
// phi = max(1 - eps, 0), eps = 1 - phi; Re_j = rho_f u_j D_j/mu with the particle's own slip and diameter. Data: eps
// 0.35-1, Re 0-1050, y 0.30-3.25, sizes to 1:4, m2 to 1.55. Limits: 1 at phi, Re -> 0; Kozeny-Carman when dense; 1/eps
// for a tiny sphere among large ones; a dilute mixture at Re 0: 1 + (3/sqrt 2) sqrt(phi m2) y_j. f_j >= 1/eps, and f
// never falls with Re or phi. Not exact: small Re at finite phi, where f - f0 scales as Re^1.5 and in theory as Re^2.
// The guard continues I beyond Re_c = 1050, with ' = d/dR and T the law of Turton and Levenspiel:
//   I = I_c (T - 1)/(T_c - 1) + [I'_c - I_c T'_c/(T_c - 1)] (R - Re_c)(Re_c/R)^3
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "closures/drag_turton_levenspiel.hpp"
#include "closures/elementary.hpp"
#include "closures/mixture.hpp"

namespace polybed::closures {

/// The law's numbers for a voidage and a composition, the same for all species: 1/eps; the factors of y_j and of y_j^2
/// in K_j; (3/2) c; and I = R [oseen (1 + 0.7664 R)^power + forchheimer]. An array, so that batches store each number
/// in a row.
using BrinkmanMedium = std::array<double, 7>;

/// The fitted constants of the form, in the order of I, then c; all positive.
struct BrinkmanOseenConstants {
  double inertia_phi = 0.9095, stretch = 0.7664, power = 0.4422, power_phi = 0.2509;
  double forchheimer = 0.04289, forchheimer_phi = 20.4, screening = 2.664;
};

/// The constants of this project, known at compile time.
struct PublishedBrinkmanOseen {
  static constexpr std::string_view name = "brinkman_oseen";
  static constexpr std::string_view help =
      "fixed spheres of any sizes, fitted to resolved flow; voidage 0.35-1, Re <= 1050";
  static constexpr std::string_view source =
      "docs/theory/closures.md: spheres in a Brinkman medium with Oseen's inertia, on lattice-Boltzmann data";
  static constexpr BrinkmanOseenConstants constants{};
};

/// Constants from a file: see closures/drag_form.hpp.
struct FittedBrinkmanOseen {
  static constexpr std::string_view name = "fitted brinkman_oseen";
  static constexpr std::string_view help = "the form of brinkman_oseen with constants of a file";
  static constexpr std::string_view source = "";
  static constexpr bool is_fitted = true;
  BrinkmanOseenConstants constants = {};
};

template <class Source>
struct BrinkmanOseenForm : Source {
  static constexpr double most_reynolds = 1050;
  Guard guard = Guard::on;

  /// For one size: y = m2 = 1.
  DragValue operator()(double eps, double re) const { return of_species(medium(eps, 1), 1, re); }

  [[nodiscard]] bool outside(double eps, double re) const { return (eps < 0.35) | (eps > 1) | (re > most_reynolds); }

  /// The same without the guard, and without a branch.
  [[nodiscard]] DragValue bare_of_size(double eps, double re) const { return bare(medium(eps, 1), 1, re); }

  /// \param m2  sum x_k/y_k^2, 1 for one size
  [[nodiscard]] BrinkmanMedium medium(double voidage, double m2) const {
    const BrinkmanOseenConstants& k = this->constants;
    const double phi = std::max(1 - voidage, 0.0), eps = 1 - phi, per_eps = 1 / eps, eps2 = eps * eps;
    const double logarithmic = phi * plain_log(std::max(phi, 1e-300));
    const double dilute = 1 + 1.5 * std::numbers::sqrt2 * std::sqrt(phi) + 135.0 / 64 * logarithmic + 10.456 * phi;
    const double f0 = 10 * phi * per_eps * per_eps + eps2 * eps2 * eps * dilute;
    const double c = phi / (2 * eps + k.screening * phi * phi * phi);
    const double oseen = 3.0 / 16 * (1 + k.inertia_phi * phi) * per_eps * per_eps / std::sqrt(std::sqrt(eps));
    return {per_eps,
            std::sqrt(phi + eps * m2) * ((1 - c) * f0 - per_eps),
            c * f0,
            1.5 * c,
            oseen,
            3.0 / 16 * k.forchheimer * (1 + k.forchheimer_phi * phi),
            -k.power + k.power_phi * phi};
  }

  /// f_j for a species with y_j, D_j over the Sauter diameter. \param re  from its own diameter and slip
  [[nodiscard]] DragValue of_species(const BrinkmanMedium& m, double y, double re) const {
    return joined(m, y, guard == Guard::on && re > most_reynolds ? beyond_data(m, re) : inertia(m, re));
  }

  /// The same without the guard, and without a branch.
  [[nodiscard]] DragValue bare(const BrinkmanMedium& m, double y, double re) const {
    return joined(m, y, inertia(m, re));
  }

 private:
  /// f_j from an inertial part I and R dI/dR.
  [[nodiscard]] static DragValue joined(const BrinkmanMedium& m, double y, const DragValue& part) {
    const auto& [per_eps, linear, square, shade, oseen, forchheimer, power] = m;
    const double viscous = std::max(y * (linear + square * y), 0.0), shaded = 1 + shade * (y - 1);
    const double inertial = part.f * shaded, root = std::sqrt(inertial);
    const double sum = std::max(viscous * std::sqrt(viscous) + inertial * root, 1e-300);
    const double third = plain_exp(plain_log(sum) * (1.0 / 3));
    return {per_eps + third * third, root * part.re_dfdre * shaded / third};
  }

  /// I and R dI/dR.
  [[nodiscard]] DragValue inertia(const BrinkmanMedium& m, double re) const {
    const auto& [per_eps, linear, square, shade, oseen, forchheimer, power] = m;
    const double stretched = 1 + this->constants.stretch * re;
    const double falling = oseen * plain_exp(power * plain_log(stretched));
    return {re * (falling + forchheimer), re * (falling * (1 + power * (stretched - 1) / stretched) + forchheimer)};
  }

  [[nodiscard]] DragValue beyond_data(const BrinkmanMedium& m, double re) const {
    const DragValue at_c = inertia(m, most_reynolds);
    const DragValue t_c = DragTurtonLevenspiel{}(1, most_reynolds), t = DragTurtonLevenspiel{}(1, re);
    const double scale = at_c.f / (t_c.f - 1), mismatch = (at_c.re_dfdre - scale * t_c.re_dfdre) / most_reynolds;
    const double ratio = most_reynolds / re, cube = ratio * ratio * ratio, fade = (re - most_reynolds) * cube;
    return {scale * (t.f - 1) + mismatch * fade, scale * t.re_dfdre + mismatch * (re * cube - 3 * fade)};
  }
};

using DragBrinkmanOseen = BrinkmanOseenForm<PublishedBrinkmanOseen>;
using DragFittedBrinkmanOseen = BrinkmanOseenForm<FittedBrinkmanOseen>;

/// The law for a mixture. Instead of a base law times a factor it computes a medium for each cell, then each f_j in it.
template <class Mean>
struct BrinkmanOseenShares {
  static constexpr std::string_view name = Mean::name, help = Mean::help, source = Mean::source;
  static constexpr std::string_view shares = "each size as a sphere in a porous medium; any sizes";
  static constexpr std::string_view shares_source =
      "docs/theory/closures.md: a Brinkman medium; the mean rises with sum x_j/y_j^2";
  static constexpr bool obeys_sum_rule = true;  ///< its mean is sum x_k f_k/y_k^2, which rises with m2
  static constexpr bool mean_is_base = false;
  using Base = Mean;
  using Medium = BrinkmanMedium;
  Base base;
  [[nodiscard]] Medium medium(double eps, const Composition& c) const {
    return base.medium(eps, c.per_square / (c.per_mean * c.per_mean));
  }
};

using MixtureBrinkmanOseen = BrinkmanOseenShares<DragBrinkmanOseen>;
using MixtureFittedBrinkmanOseen = BrinkmanOseenShares<DragFittedBrinkmanOseen>;

}  // namespace polybed::closures
