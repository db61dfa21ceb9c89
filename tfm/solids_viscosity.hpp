// The deviatoric stress of the solids on the staggered grid: div(phi_j T_j)/((phi_j + 1e-4 X_j) rho_j) with
// T_j = (mu_s/phi)(grad U_j + grad U_j^T - 2/3 div U_j I): the viscosity, like the pressure, is shared by volume.
// Shear is transmitted where there are solids on both sides (fluid::SolidEdge).
#pragma once

#include <algorithm>

#include "fluid/boundaries.hpp"
#include "tfm/fields.hpp"

namespace polybed::tfm {

/// Solids that are added to phi_j where what diffuses in species j is divided by it, so that an empty cell is left in
/// peace: 1e-4 of the species' share in the whole bed, which is neutral to cutting a species in two.
[[nodiscard]] inline double diffusion_floor(const Constants& constants, std::size_t species) {
  return std::max(1e-4 * constants.bed_share[species], 1e-12);  // of a species of share 0: 0/1e-12
}

/// Fills stress.strain with 2 D':D' of each species in the owned cells, 1/s2; gamma^2 in simple shear. Shear is the
/// mean of the squares on the edges around, so that a ripple from cell to cell is seen, each as far as the edge
/// transmits shear: the viscosity times it is what the viscous force takes from the mean motion.
void strain_rates(const Constants&, const fluid::Boundaries&, Fields&);

/// Adds the viscous force per mass of each species. Ghosts of stress.viscosity and of the velocities must be filled.
/// \param weight  work space: phi_j mu_s/phi on cells
void add_solids_viscosity(const Constants&, const fluid::Boundaries&, Fields&, core::Field& weight);

}  // namespace polybed::tfm
