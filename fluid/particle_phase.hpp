// The interface between the averaged fluid and individual particles: all data of theirs for a step of the fluid, as
// sums over particles on its faces. Continuous solids use interphase.hpp.
#pragma once

#include "core/numerics/field.hpp"

namespace polybed::fluid {

/// Per volume of a cell, psi; w: weight of a particle on a face. Over an interval dt the particles have moved through a
/// frozen fluid and received the impulse I from it by drag and added mass. The fluid's change dU, its own convection
/// (U.grad)U and a change dG of the pressure's gradient act on a particle of velocity U_p and inertia M = m + m_a in
/// one impulse at the end of the interval,
///
///   dU_p = g dU + (m_a/M) s (dU + dt (U.grad)U) - (V/M) s dt dG,   g = 1 - exp(-k dt/M),  s = g M/(k dt),
///
/// with k the drag over the slip. The sums below are its effect on the fluid's momentum and on the flux of volume.
struct ParticlePhase {
  core::Field voidage;         ///< eps in cells
  core::FaceField voidage_on;  ///< eps on faces
  core::FaceField flux;        ///< sum w V U_p: volume flux of the particles, m/s
  core::FaceField impulse;     ///< sum w I: momentum that the fluid has lost to them since its last step, kg/(m2 s)
  core::FaceField drag;        ///< sum w m [g + (m_a/M) s], kg/m3: times dU, the further loss
  core::FaceField follow;      ///< sum w V [g + (m_a/M) s]: times dU, flux that the particles gain
  core::FaceField slide;       ///< sum w V [1 - (m/M) s]: times dt dG, the fluid's gain from slower particles
  core::FaceField yield;       ///< sum w V^2 s/M, m3/kg: times -dt dG, flux that the particles gain
  core::FaceField carry;       ///< sum w m (m_a/M) s, kg/m3: times dt (U.grad)U; empty without added mass
  core::FaceField carry_flux;  ///< sum w V (m_a/M) s likewise

  ParticlePhase(const core::Grid& grid, bool added_mass)
      : voidage(core::make_field(grid, 1)),
        voidage_on(core::make_face_field(grid, 1)),
        flux(core::make_face_field(grid)),
        impulse(core::make_face_field(grid)),
        drag(core::make_face_field(grid)),
        follow(core::make_face_field(grid)),
        slide(core::make_face_field(grid)),
        yield(core::make_face_field(grid)) {
    if (added_mass) carry = carry_flux = core::make_face_field(grid);
  }
  [[nodiscard]] bool added_mass() const { return !carry[0].empty(); }
};

}  // namespace polybed::fluid
