// Effect of closure forces on individual particles on all phases.
#pragma once

#include "fluid/boundaries.hpp"
#include "tfm/fields.hpp"

namespace polybed::tfm {

/// On the faces of an axis adds f_j/rho_j to the accelerations of the solids and -sum_j phi_j f_j/(eps rho_f) to the
/// fluid's, with f_j = fields.force.on_solids: exact opposites on each face where solids move. In form B, which has no
/// pressure gradient on the solids, f_j becomes f_j + sum_k phi_k f_k/eps, which includes the gradient from the
/// reaction in the fluid of a uniform bed.
void share_particle_forces(const Constants&, const fluid::Boundaries&, int axis, Fields&);

}  // namespace polybed::tfm
