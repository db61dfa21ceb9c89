// From the fluid that a case names to its density and viscosity.
#pragma once

#include "core/case/scene.hpp"

namespace polybed::relevance {

/// Density and viscosity of the fluid.
struct FluidConstants {
  double density = 0;    ///< rho_f, kg/m3; of a compressible fluid rho_0, that at the outlet's pressure
  double viscosity = 0;  ///< mu, Pa s
};

/// Water and air from their temperature; any other fluid from the density and viscosity given, which also
/// override. The density is that at the outlet's pressure. Throws core::CaseError that names the key and its range.
[[nodiscard]] FluidConstants fluid_constants(const core::Fluid& fluid);

}  // namespace polybed::relevance
