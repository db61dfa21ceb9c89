// Momentum exchange between two solid species: collisions after Syamlal 1987, contact in a packed bed after Gera 2004.
#pragma once

#include <numbers>

namespace polybed::closures {

/// Properties of a pair of species; symmetric in its members.
struct SpeciesPair {
  double diameter_j, diameter_k;  ///< m
  double density_j, density_k;    ///< kg/m3
  double restitution = 0.9;       ///< e
  double friction = 0.3;          ///< C_f
};

/// Radial distribution at contact, Lebowitz 1964: 1/eps + 3 D_j D_k sum(phi_m/D_m) / [eps^2 (D_j + D_k)].
/// \param surface  sum over all species of phi_m/D_m, 1/m
[[nodiscard]] inline double radial_distribution(const SpeciesPair& pair, double voidage, double surface) {
  const double per_voidage = 1 / voidage;
  return per_voidage + 3 * pair.diameter_j * pair.diameter_k / (pair.diameter_j + pair.diameter_k) * surface *
                           per_voidage * per_voidage;
}

/// K_jk / (phi_j phi_k), kg/(m3 s): finite if a species vanishes, the same for (j, k) and (k, j).
///   3 (1+e)(pi/2 + C_f pi^2/8)(D_j+D_k)^2 rho_j rho_k g0 |U_j - U_k| / [2 pi (rho_j D_j^3 + rho_k D_k^3)] +
///   C_s p_s/phi^2
/// \param g0       radial_distribution  \param speed  |U_j - U_k|, m/s
/// \param contact  C_s p_s / phi^2, kg/(m3 s): friction in a packed bed, 0 without packing
[[nodiscard]] inline double species_exchange(const SpeciesPair& pair, double g0, double speed, double contact) {
  constexpr double pi = std::numbers::pi;
  const double reach = pair.diameter_j + pair.diameter_k;
  const double mass_j = pair.density_j * pair.diameter_j * pair.diameter_j * pair.diameter_j;
  const double mass_k = pair.density_k * pair.diameter_k * pair.diameter_k * pair.diameter_k;
  return 3 * (1 + pair.restitution) * (pi / 2 + pair.friction * pi * pi / 8) * reach * reach * pair.density_j *
             pair.density_k / (2 * pi * (mass_j + mass_k)) * g0 * speed +
         contact;
}

}  // namespace polybed::closures
