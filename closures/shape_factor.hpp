// Drag on a particle over the drag on the sphere of its volume, both by one formula.
//
// The formulas have the form creeping + transition Re^power + newton Re^2/(Re + onset), with numbers that depend on the
// sphericity psi (surface of the sphere of equal volume over the surface of the particle), 0.2 to 1 here. It is C_D
// Re/24 of a lone particle, or the drag in a packed bed over that in creeping flow.
// Re uses the superficial slip eps |U_f - U_j|, as the drag laws do, and the diameter of the sphere of equal volume.
// Beyond Re 2.5e4 all tend smoothly to a constant C_D. At psi = 1 the factor is exactly 1.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "closures/drag_value.hpp"

namespace polybed::closures {

/// Drag of particles of one sphericity, over a common factor.
struct ShapeDrag {
  double creeping = 1, transition = 0, power = 1, newton = 0, onset = 1;
  [[nodiscard]] DragValue operator()(double re) const {
    const double middle = transition * std::pow(re, power), last = newton * re * re / (re + onset);
    return {creeping + middle + last, power * middle + last * (1 + onset / (re + onset))};
  }
};

/// Haider and Levenspiel, Powder Technol. 58 (1989) 63, the correlation for all sphericities: C_D = 24/Re (1 + A Re^B)
/// + C/(1 + D/Re). Made from particles of psi 0.026 to 1 at Re to 2.5e4. In creeping flow all shapes are dragged alike.
[[nodiscard]] inline ShapeDrag haider_levenspiel(double psi) {
  const double a = std::exp(2.3288 + psi * (-6.4581 + psi * 2.4486)), b = 0.0964 + 0.5565 * psi;
  const double c = std::exp(4.905 + psi * (-13.8944 + psi * (18.4222 - psi * 10.2599)));
  const double d = std::exp(1.4681 + psi * (12.2584 + psi * (-20.7322 + psi * 15.8855)));
  return {1, a, b, c / 24, d};
}

/// Ganser, Powder Technol. 77 (1993) 143, eq. 18 and table 7, isometric particles (d_n = d_v) in an unbounded fluid:
/// C_D/K2 = 24/X (1 + 0.1118 X^0.6567) + 0.4305/(1 + 3305/X), X = Re K1 K2 to 1e5; K1 = 3/(1 + 2 psi^-1/2),
/// K2 = 10^(1.8148 (-log10 psi)^0.5743).
[[nodiscard]] inline ShapeDrag ganser(double psi) {
  const double per_k1 = (1 + 2 / std::sqrt(psi)) / 3;
  const double k2 = std::pow(10, 1.8148 * std::pow(std::abs(std::log10(psi)), 0.5743)), k = k2 / per_k1;
  return {per_k1, per_k1 * 0.1118 * std::pow(k, 0.6567), 0.6567, k2 * 0.4305 / 24, 3305 / k};
}

/// Ergun, Chem. Eng. Prog. 48 (1952) 89, T(3.24), with psi D, the diameter of the sphere that has the particle's
/// surface for its volume, in place of D; over 150 (1-eps)/18 and at Re/(1-eps). A packed bed, eps below 0.8.
[[nodiscard]] inline ShapeDrag ergun(double psi) { return {1 / (psi * psi), 1.75 / 150 / psi, 1, 0, 1}; }

/// The factor on the drag of a particle, 1 as it stands; of a sphere exactly 1.
struct ShapeFactor {
  ShapeDrag own = {}, sphere = {};
  bool packed = false;  ///< the formula is of Re/(1-eps)
  [[nodiscard]] double operator()(double voidage, double re) const {
    const double at = argument(voidage, re);
    return own(at).f / sphere(at).f;
  }
  /// f and Re df/dRe with the factor.
  [[nodiscard]] DragValue operator()(const DragValue& drag, double voidage, double re) const {
    const double at = argument(voidage, re);
    const DragValue one = own(at), other = sphere(at);
    const double factor = one.f / other.f, slope = (one.re_dfdre - factor * other.re_dfdre) / other.f;
    return {factor * drag.f, factor * drag.re_dfdre + slope * drag.f};
  }

 private:
  [[nodiscard]] double argument(double voidage, double re) const {
    return packed ? re / std::max(1 - voidage, 1e-9) : re;
  }
};

struct ShapeLaw {
  std::string_view name, help, source;
  ShapeDrag (*drag)(double psi);
  bool packed = false;
};
/// The first is the default: beds are what is computed, and near spheres the others disagree by half
/// (docs/theory/closures.md).
inline constexpr ShapeLaw shape_laws[] = {
    {"ergun", "a packed or fluidised bed, voidage below 0.8", "Ergun 1952, with psi D", ergun, true},
    {"ganser", "lone isometric particles, from creeping flow to Re 1e5", "Ganser 1993, eq. 18 and table 7", ganser},
    {"haider_levenspiel", "lone particles, Re to 25,000; no effect of shape in creeping flow",
     "Haider and Levenspiel 1989", haider_levenspiel}};

/// A law of this list; the first for any other name, which is left to the chooser.
[[nodiscard]] constexpr const ShapeLaw& shape_law_named(std::string_view name) {
  for (const ShapeLaw& law : shape_laws)
    if (law.name == name) return law;
  return shape_laws[0];
}

/// Of a law of this list. \param psi  sphericity, above 0 and at most 1
[[nodiscard]] inline ShapeFactor shape_factor(const ShapeLaw& law, double psi) {
  return {law.drag(psi), law.drag(1), law.packed};
}

/// The factors of the species of a bed.
struct BedShape {
  std::vector<ShapeFactor> species;
  ShapeFactor mean;  ///< of one size: of a species alone, or of the sphericity with the surface of all
};

/// Sphericity of the particles of the Sauter diameter that have the surface of the mixture:
/// sum x_j/D_j over sum x_j/(psi_j D_j).
[[nodiscard]] inline double mean_sphericity(std::span<const double> psi, std::span<const double> share,
                                            std::span<const double> diameter) {
  double spheres = 0, particles = 0;
  for (std::size_t j = 0; j < psi.size(); ++j) {
    spheres += share[j] / diameter[j];
    particles += share[j] / (psi[j] * diameter[j]);
  }
  return spheres / particles;
}

}  // namespace polybed::closures
