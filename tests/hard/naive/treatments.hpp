// Textbook treatments that hard cases must defeat, for tests only: each replaces one treatment of the product and
// leaves the rest as it is. Production code knows nothing of them.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/case/scene.hpp"
#include "hard/textbook.hpp"

namespace polybed::hard::naive {

/// A run of a scene with the treatment of a name; `start` as in hard::Trial::begin.
///   divide_by_phi              momentum per volume phi U is the unknown, U = m / max(phi, 1e-10)
///   divide_by_phi composition  shares of the species phi_j / sum phi_k, without a floor
///   clip_rhs                   a fraction at or below 0 is not lowered further; implicit
///   hard_packing               no solids pressure: nothing flows into a cell at phi_max
///   drag_explicit              third-order explicit steps of one length, Courant number 0.5 of the fastest inlet
///   raw_drag                   drag laws and mixtures without their guards (unguarded_alpha: the same)
///   central_flux               plain means of phi_j on faces
///   advective_momentum         (U.grad)U, of first order
///   unbalanced_gravity         weight from the cell above a face, solids pressure from both
///   added_mass_lagged          added mass as a force, of the accelerations of the evaluation before
///   hidden_unit                1e-3, whatever the units, added to the exchange coefficients
///   jacobi_preconditioner      continuity rows divided by their diagonal, 1/dt and what flows out; implicit
///   cold_restart               null: the case itself goes on without the restart that a checkpoint asks for
///   nothing explicit, nothing implicit   no change at all: what the runs themselves do
/// Throws std::invalid_argument for any other name.
[[nodiscard]] std::unique_ptr<hard::Run> make_run(const std::string& name, core::Scene scene, core::Timers& timers,
                                                  const std::function<void(tfm::Model&)>& start);

}  // namespace polybed::hard::naive
