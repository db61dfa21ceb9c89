// Convection of momentum in conservative form: momentum that leaves one face arrives at the next.
//
//   a = -[div(F U) - U div F] / phi,   phi = phi_j, F = F_j for a species; phi = eps, F = J - sum F_j for the fluid
//
// with fluid/convection.hpp and the fluxes of continuity, so that with (1) the sum of phi rho U over faces changes only
// by flow through the ends.
#pragma once

#include "fluid/boundaries.hpp"
#include "tfm/fields.hpp"

namespace polybed::tfm {

/// Least fraction of species j as a divisor of its momentum's convection: 1e-3 of all solids, shared as in the bed, so
/// that a species can be split in two; an empty species then has a finite divisor.
[[nodiscard]] inline double momentum_floor(double bed_share) { return 1e-3 * (bed_share > 0 ? bed_share : 1.0); }

class ConservativeConvection {
 public:
  /// limited: velocities are upwind with half a limited slope; otherwise upwind alone.
  /// The fields must outlive their use.
  ConservativeConvection(const Constants&, const fluid::Boundaries&, bool limited, Fields&);

  /// Sets the accelerations of all phases, and fills ghosts of the fluxes from continuity(). Collective.
  void set();

 private:
  static void carry(const ConservativeConvection& by, const core::FaceField& flux, const core::FaceField& velocity,
                    const core::Field& fraction, double floor, bool of_fluid, core::FaceField& acceleration);

  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  bool limited_;
  Fields& fields_;
  core::FaceField fluid_flux_;  ///< J - sum F_j, m/s, with ghosts owned by other cells
  std::vector<fluid::Ghosts> flux_ghosts_;
};

}  // namespace polybed::tfm
