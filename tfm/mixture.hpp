// Cell values for the closures: total solids fraction, shares of the species, superficial slip.
#pragma once

#include "fluid/boundaries.hpp"
#include "tfm/fields.hpp"

namespace polybed::tfm {

/// Solids added to a cell's composition, so that an empty cell has the whole bed's composition: x_j = (max(phi_j, 0) +
/// floor X_j) / (sum max(phi_k, 0) + floor). Unchanged if a species is split.
constexpr double composition_floor = 1e-4;

/// Fills solids_fraction, voidage and share in all cells, ghosts included, from the fractions.
void composition(const Constants& constants, Fields& fields);

/// Fills slip_superficial in the cells of the solids with the means of eps (U_f - U_j) on opposite faces, which a
/// nearby surface does not change.
void superficial_slip(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields);

/// Multiplies slip_superficial by rho_f/rho_0: the closures, which use rho_0, then have the local Reynolds number.
void weigh_slip_by_density(const Constants& constants, Fields& fields);

}  // namespace polybed::tfm
