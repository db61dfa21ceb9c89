// Composition of a mixture of sizes: T(1.41)-(1.44), (3.13)-(3.17), (4.18)-(4.28).
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace polybed::closures {

/// Sauter mean diameter 1 / sum(x_j / D_j), m. share: x_j, sums to 1; diameter: D_j, m.
[[nodiscard]] inline double sauter_diameter(std::span<const double> share, std::span<const double> diameter) {
  double sum = 0;
  for (std::size_t j = 0; j < share.size(); ++j) sum += share[j] / diameter[j];
  return 1 / sum;
}

/// Mean polydispersity index y_m = sum x_j D_j / D_Sauter; >= 1, and 1 only for equal sizes.
[[nodiscard]] inline double poly_index_mean(std::span<const double> share, std::span<const double> diameter) {
  double sum = 0;
  for (std::size_t j = 0; j < share.size(); ++j) sum += share[j] * diameter[j];
  return sum / sauter_diameter(share, diameter);
}

/// Net over pure specification coefficient: alpha_j = eps Omega_j + (1-eps) y_j^2.
[[nodiscard]] inline double alpha_of_omega(double voidage, double omega, double poly_index) {
  return voidage * omega + (1 - voidage) * poly_index * poly_index;
}

/// Numbers common to all species in a cell.
struct Composition {
  double per_mean;        ///< sum x_j / D_j, the inverse of the Sauter diameter, 1/m
  double average;         ///< sum x_j D_j, m
  double largest;         ///< the greatest D_j, including absent species, m
  double per_square = 0;  ///< sum x_j / D_j^2, 1/m2; only for laws that need it
};
[[nodiscard]] inline Composition composition_of(std::span<const double> share, std::span<const double> diameter) {
  Composition sum{0, 0, 0};
  for (std::size_t j = 0; j < share.size(); ++j) {
    sum.per_mean += share[j] / diameter[j];
    sum.average += share[j] * diameter[j];
    sum.largest = std::max(sum.largest, diameter[j]);
    sum.per_square += share[j] / (diameter[j] * diameter[j]);
  }
  return sum;
}

/// A cell as input to a mixture law. per_mean: 1/mean, so that a loop over cells divides once.
struct MixtureCell {
  double voidage, mean, per_mean;
  double coefficient;  ///< the law's own number, common to all species
};

/// One species' drag in a mixture, in the form common to all laws in the menu:
/// f_j = offset + factor f_base(voidage, rho_f |u_j| length / mu).
struct MixtureTerms {
  double voidage, length, offset, factor;
};

/// h(eps) of T(4.28): (1-eps)(crossing-eps)/(crossing eps). \param crossing  the voidage at which h is 0: 1 - gamma
[[nodiscard]] inline double cello_h(double voidage, double crossing = 0.73) {
  return (1 - voidage) * (crossing - voidage) / (crossing * voidage);
}

/// h with its guard G4: evaluated at eps >= 0.35, and not below -0.95 y_m/(y_max - 1), which keeps Omega_j > 0 for
/// every mixture and the sum rule exact. Branch-free: the bound is huge, not infinite, for equal sizes.
[[nodiscard]] inline double cello_h_guarded(double voidage, double y_max, double y_m, double crossing = 0.73) {
  return std::max(cello_h(std::max(voidage, 0.35), crossing), -0.95 * y_m / std::max(y_max - 1, 1e-300));
}

}  // namespace polybed::closures
