// The deviatoric stress of the solids on the staggered grid: div(phi_j T_j)/((phi_j + 1e-4 X_j) rho_j) with
// T_j = (mu_s/phi)(grad U_j + grad U_j^T - 2/3 div U_j I): the viscosity, like the pressure, is shared by volume.
// Shear is transmitted where there are solids on both sides (fluid::SolidEdge).
#pragma once

#include <algorithm>

#include "fluid/boundaries.hpp"
#include "tfm/fields.hpp"

namespace polybed::tfm {

/// Added to phi_j as a divisor of diffusion in species j, so that an empty cell stays undisturbed: 1e-4 of the species'
/// share in the whole bed, so that splitting a species in two changes nothing.
[[nodiscard]] inline double diffusion_floor(const Constants& constants, std::size_t species) {
  return std::max(1e-4 * constants.bed_share[species], 1e-12);  // for a species of share 0: 0/1e-12
}

/// Fills stress.strain with 2 D':D' of each species in the owned cells, 1/s2; gamma^2 in simple shear. Shear is the
/// mean of the squares on the surrounding edges, which detects a ripple from cell to cell, each times the share that
/// the edge transmits: times the viscosity it equals the energy that the viscous force takes from the mean motion.
void strain_rates(const Constants&, const fluid::Boundaries&, Fields&);

/// Adds the viscous force per mass of each species. Needs ghosts of stress.viscosity and of the velocities.
/// \param weight  work space: phi_j mu_s/phi on cells
void add_solids_viscosity(const Constants&, const fluid::Boundaries&, Fields&, core::Field& weight);

}  // namespace polybed::tfm
