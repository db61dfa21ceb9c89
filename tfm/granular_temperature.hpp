// Transport of the granular temperature: what moves theta_j from cell to cell.
#pragma once

#include "tfm/solids.hpp"

namespace polybed::tfm {

/// Adds -U_j.grad theta_j, with theta_j on faces from upwind (with half a limited slope if `limited`), and
/// (2/3) div(k_j grad theta_j)/((phi_j + 1e-4 X_j) rho_j) to the rates of the temperatures, k_j = phi_j times
/// granular.conductivity. Nothing is conducted through walls, the distributor and the outlet. Sets ghosts of both.
/// \param flux  work space
void add_temperature_transport(const Constants&, const fluid::Boundaries&, Scheme, Fields&, core::FaceField& flux);

}  // namespace polybed::tfm
