// Forces of closures on single particles: from cells, where closures find them, to the faces of all phases.
#pragma once

#include "fluid/boundaries.hpp"
#include "tfm/fields.hpp"

namespace polybed::tfm {

/// Adds f_j/rho_j to the accelerations of the solids and -sum_j phi_j f_j/(eps rho_f) to the fluid's, f_j being the
/// mean of fields.force.on_solids in both cells of a face: exact opposites on each face where solids move. In form B,
/// which has no pressure gradient on the solids, f_j becomes f_j + sum_k phi_k f_k/eps: with the gradient that the
/// reaction makes in the fluid of a uniform bed. Ghosts of the forces are filled. Collective.
void share_particle_forces(const Constants&, const fluid::Boundaries&, Fields&);

}  // namespace polybed::tfm
