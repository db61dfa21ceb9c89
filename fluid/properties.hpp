// From the fluid that a case names to its density and viscosity.
#pragma once

#include "core/case/scene.hpp"
#include "fluid/fluid_state.hpp"

namespace polybed::fluid {

/// Water and air from their temperature; any other fluid from the density and viscosity given, which also
/// override. The density is that at the outlet's pressure. Throws core::CaseError that names the key and its range.
[[nodiscard]] FluidConstants fluid_constants(const core::Fluid& fluid);

}  // namespace polybed::fluid
