// Transport of the granular temperature from cell to cell.
#pragma once

#include "tfm/solids.hpp"

namespace polybed::tfm {

/// Adds -U_j.grad theta_j, with upwind theta_j on faces (with half a limited slope if `limited`), and (2/3) div(k_j
/// grad theta_j)/((phi_j + 1e-4 X_j) rho_j) to the rates of the temperatures, k_j = phi_j times granular.conductivity.
/// Walls, the distributor and the outlet conduct nothing. Sets ghosts of both; fields.solids_flux is work space.
void add_temperature_transport(const Constants&, const fluid::Boundaries&, Scheme, Fields&);

}  // namespace polybed::tfm
