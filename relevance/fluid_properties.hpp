// Density and viscosity of the fluid in a case, and its slip on the spheres of a scene.
#pragma once

#include <span>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::relevance {

/// Density and viscosity of the fluid.
struct FluidConstants {
  double density = 0;    ///< rho_f, kg/m3; compressible: rho_0 at the outlet's pressure
  double viscosity = 0;  ///< mu, Pa s
};

/// Water and air from their temperature; any other fluid from the given density and viscosity, which also override. The
/// density is at the outlet's pressure. Throws core::CaseError that names the key and its range.
[[nodiscard]] FluidConstants fluid_constants(const core::Fluid& fluid);

/// kg/m3: lighter than any liquid, denser than gases at some 50 bar.
inline constexpr double lightest_liquid = 100;

/// Mean free path of an ideal gas at a pressure, m: closures/gas_slip.hpp with R T = P/rho.
[[nodiscard]] double mean_free_path_at(double pressure, double density, double viscosity);

/// Divisors of the drag on spheres of these diameters, m: Cunningham's at the outlet's pressure if the scene has
/// effects.gas_slip, else 1.
[[nodiscard]] std::vector<double> slip_divisors(const core::Scene& scene, std::span<const double> diameters);

}  // namespace polybed::relevance
