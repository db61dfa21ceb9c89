// The densest random packing of spheres of several sizes, from the packing of each size alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace polybed::closures {

/// pi/sqrt(18): the solids fraction of equal spheres in a crystal, the densest possible (Kepler; Hales 2005).
inline constexpr double crystal_packing = 0.74048048969306104;

/// A law in this file: phi_max from shares, diameters and packings.
using MixturePacking = double (*)(std::span<const double>, std::span<const double>, std::span<const double>);

/// phi_max of two sizes after Fedors and Landel (Powder Technol. 23, 1979, 225-231). P_1, x_1 for the large, r = small
/// over large diameter, a = P_1 + (1-P_1) P_2:
///   x_1 <= P_1/a:  P_2 + [P_1 - P_2 + (1 - sqrt r)(1 - P_1) P_2] a x_1/P_1;  else  P_1 + (1 - sqrt r) a (1 - x_1).
/// Continuous; P_2 and P_1 at its ends.
/// \param share     x_j, >= 0, sums to 1  \param diameter  D_j, m, > 0
/// \param packing   P_j in (0, 1)         All of length 2, in any order.
[[nodiscard]] inline double packing_fedors_landel(std::span<const double> share, std::span<const double> diameter,
                                                  std::span<const double> packing) {
  const std::size_t large = diameter[0] >= diameter[1] ? 0 : 1, small = 1 - large;
  const double p1 = packing[large], p2 = packing[small], x1 = share[large];
  const double gain = 1 - std::sqrt(diameter[small] / diameter[large]), a = p1 + (1 - p1) * p2;
  return x1 <= p1 / a ? p2 + (p1 - p2 + gain * (1 - p1) * p2) * a * x1 / p1 : p1 + gain * a * (1 - x1);
}

/// The minimum of two numbers, with the corner between them rounded over a width: C1.
[[nodiscard]] inline double rounded_minimum(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - 0.25 * width * h * h;
}

/// phi_max of any number of sizes after Yu and Standish (Powder Technol. 52, 1987, 233-241), as
///   phi_max = min_i P_i / [1 - sum_j (1 - P_i/p_ij) x_j / X_ij],   r_ij = smaller over larger diameter,
///   p_ij = P_i + P_i (1 - P_i)(1 - 2.35 r_ij + 1.35 r_ij^2), P_i above r = 0.741;
///   X_ij = (1 - r_ij^2)/(2 - P_i) for j coarser than i, 1 minus that for j finer.
/// The minimum is rounded over 0.005, so that it is C1 in the composition.
/// \param share     x_j, >= 0, sums to 1  \param diameter  D_j, m, > 0  \param packing  P_j in (0, 1)
[[nodiscard]] inline double packing_yu_standish(std::span<const double> share, std::span<const double> diameter,
                                                std::span<const double> packing) {
  constexpr double no_gain_above = 0.741, rounding = 0.005;
  double least = 1;
  for (std::size_t i = 0; i < share.size(); ++i) {
    const double p = packing[i];
    double sum = 0;
    for (std::size_t j = 0; j < share.size(); ++j) {
      const double r = std::min(diameter[i], diameter[j]) / std::max(diameter[i], diameter[j]);
      if (j == i || r >= no_gain_above) continue;
      const double pair = p + p * (1 - p) * (1 - 2.35 * r + 1.35 * r * r);
      const double coarser = (1 - r * r) / (2 - p);
      sum += (1 - p / pair) * share[j] / (diameter[j] > diameter[i] ? coarser : 1 - coarser);
    }
    const double value = sum < 1 ? std::min(p / (1 - sum), 1.0) : 1.0;
    least = i == 0 ? value : rounded_minimum(least, value, rounding);
  }
  return least;
}

}  // namespace polybed::closures
