// Forces of closures on single particles: what they do to all phases.
#pragma once

#include "fluid/boundaries.hpp"
#include "tfm/fields.hpp"

namespace polybed::tfm {

/// On the faces of an axis adds f_j/rho_j to the accelerations of the solids and -sum_j phi_j f_j/(eps rho_f) to the
/// fluid's, f_j being fields.force.on_solids: exact opposites on each face where solids move. In form B, which has no
/// pressure gradient on the solids, f_j becomes f_j + sum_k phi_k f_k/eps: with the gradient that the reaction makes in
/// the fluid of a uniform bed.
void share_particle_forces(const Constants&, const fluid::Boundaries&, int axis, Fields&);

}  // namespace polybed::tfm
