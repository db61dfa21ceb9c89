// Slip of a rarefied gas on small spheres, and Brownian motion.
#pragma once

#include <cmath>
#include <numbers>

namespace polybed::closures {

/// Boltzmann's constant, J/K, exact since 2019.
inline constexpr double boltzmann = 1.380649e-23;

/// Mean free path of a gas, m: (mu/rho) sqrt(pi/(2 R T)), p = rho R T (Maxwell's gas; Bird, Molecular Gas Dynamics,
/// 1994, ch. 1). Air at 20 degC: 65 nm. \param specific_gas_constant  R, J/(kg K)
[[nodiscard]] inline double mean_free_path(double density, double viscosity, double temperature,
                                           double specific_gas_constant) {
  return viscosity / density * std::sqrt(std::numbers::pi / (2 * specific_gas_constant * temperature));
}

/// Divisor of the drag, 1 + Kn (1.257 + 0.4 exp(-1.1/Kn)), Kn = 2 lambda/d (Cunningham 1910 with the constants of
/// Davies, Proc. Phys. Soc. 57, 1945, 259); 1 at Kn = 0.
[[nodiscard]] inline double cunningham_divisor(double knudsen) {
  return knudsen > 0 ? 1 + knudsen * (1.257 + 0.4 * std::exp(-1.1 / knudsen)) : 1;
}

/// Diffusivity of a small sphere, m2/s: k_B T/(3 pi mu d) (Einstein, Ann. Phys. 17, 1905, 549), in creeping flow.
[[nodiscard]] inline double brownian_diffusivity(double temperature, double viscosity, double diameter) {
  return boltzmann * temperature / (3 * std::numbers::pi * viscosity * diameter);
}

}  // namespace polybed::closures
