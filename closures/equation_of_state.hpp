// Density of a fluid from its pressure, at fixed temperature: the Tait liquid and the ideal gas.
#pragma once

#include <cmath>

namespace polybed::closures {

/// p = (p_0 + B)(rho/rho_0)^n - B, as in the short paper.
struct TaitLiquid {
  double reference_density;            ///< rho_0, kg/m3, at p_0
  double reference_pressure = 101325;  ///< p_0, Pa
  double stiffness = 3.0e8;            ///< B, Pa, > 0
  double exponent = 7;                 ///< n, > 0

  /// rho, kg/m3, at an absolute pressure, Pa, above -B; NaN below, where the liquid would be torn.
  [[nodiscard]] double density(double pressure) const {
    return reference_density * std::pow((pressure + stiffness) / (reference_pressure + stiffness), 1 / exponent);
  }
  /// p, Pa, at a density, kg/m3, > 0.
  [[nodiscard]] double pressure(double density) const {
    return (reference_pressure + stiffness) * std::pow(density / reference_density, exponent) - stiffness;
  }
  /// Compressibility (drho/dp)/rho = 1/(n (p + B)), 1/Pa.
  [[nodiscard]] double compressibility(double pressure) const { return 1 / (exponent * (pressure + stiffness)); }
};

/// p = rho R T at fixed temperature: no equation for the energy, so sound is isothermal.
struct IdealGas {
  double gas_constant;  ///< R, J/(kg K); dry air 287.05
  double temperature;   ///< T, K, > 0

  /// rho, kg/m3, at an absolute pressure, Pa, > 0.
  [[nodiscard]] double density(double pressure) const { return pressure / (gas_constant * temperature); }
  /// p, Pa, at a density, kg/m3, > 0.
  [[nodiscard]] double pressure(double density) const { return density * gas_constant * temperature; }
  /// Compressibility (drho/dp)/rho = 1/p, 1/Pa.
  [[nodiscard]] double compressibility(double pressure) const { return 1 / pressure; }
};

/// Speed of sound, m/s, sqrt(dp/drho) = 1/sqrt(rho kappa).
/// \param law       TaitLiquid or IdealGas
/// \param pressure  absolute, Pa, in the range of the law
template <class Law>
[[nodiscard]] double sound_speed(const Law& law, double pressure) {
  return 1 / std::sqrt(law.density(pressure) * law.compressibility(pressure));
}

}  // namespace polybed::closures
