// The viscous stress of the averaged fluid on faces: div(eps tau)/(eps rho_f), the last term of (3).
#pragma once

#include "fluid/boundaries.hpp"
#include "fluid/fluid_state.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::fluid {

/// Adds div(eps tau)/(eps rho_f), tau = mu (grad U + grad U^T - 2/3 div U I), to the fluid's acceleration, m/s2.
/// Second order on the staggered grid: normal stresses in cells, shear stresses on edges with the mean eps of the four
/// adjacent cells. Walls act through the ghosts of the velocity.
/// \param fluid  velocity and voidage, ghosts filled
void add_viscous_stress(const core::Grid& grid, const Boundaries& boundaries, const FluidState& fluid,
                        const relevance::FluidConstants& constants, core::FaceField& acceleration);

/// Greatest rate of the stress, over twice the kinematic viscosity, 1/m2: an explicit step dt is stable while 2 nu dt
/// times this is at most 1. sum(1/h^2) in a box; in a round column cut cells and wall friction also count. Collective.
[[nodiscard]] double viscous_rate(const core::Grid& grid);

}  // namespace polybed::fluid
