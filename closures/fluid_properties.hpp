// Density and viscosity of water and air as functions of temperature.
#pragma once

namespace polybed::closures {

/// Density of water at 1 atm, kg/m3, after Tanaka et al. 2001 (CIPM). kelvin: 273.15-313.15; else std::out_of_range.
[[nodiscard]] double water_density(double kelvin);

/// Viscosity of water at 1 atm, Pa s, after Patek et al. 2009 (IAPWS). kelvin: 273.15-313.15; else std::out_of_range.
[[nodiscard]] double water_viscosity(double kelvin);

/// Density of dry air as an ideal gas, R = 287.05 J/(kg K), kg/m3. kelvin: 200-1000; pressure in Pa.
[[nodiscard]] double air_density(double kelvin, double pressure = 101325);

/// Viscosity of air after Sutherland, 1.458e-6 T^1.5/(T + 110.4), Pa s. kelvin: 200-1000; else std::out_of_range.
[[nodiscard]] double air_viscosity(double kelvin);

}  // namespace polybed::closures
