// The mass of a compressible fluid in the column, and the account of what has flowed in and out.
#pragma once

#include "fluid/boundaries.hpp"
#include "fluid/fluid_state.hpp"

namespace polybed::fluid {

/// Mass flow, kg/s: in through the distributor and where it enters through a side, out through the outlet and where it
/// leaves through a side.
struct MassFlow {
  double in = 0, out = 0;
};

/// Flow at one time: rho_f Q on the boundary faces, as in the fluid's continuity equation. Zero in a closed column.
/// Collective.
/// \param own_flux  Q, volume flux of the fluid alone, m/s
[[nodiscard]] MassFlow mass_flow(const core::Grid& grid, const Boundaries& boundaries, const FluidState& fluid,
                                 const core::FaceField& own_flux);

/// Mass in the owned cells, kg, sum of eps rho_f.
[[nodiscard]] double fluid_mass(const core::Grid& grid, const FluidState& fluid);

/// What was in the column at the start and what has passed its ends since, kg.
struct MassAccount {
  double start = 0, in = 0, out = 0;
  /// (start + in - out - stored) relative to the larger of what was there and what came in.
  [[nodiscard]] double error(double stored) const;
};

/// Keeps the account over the steps of an integration; the flow is taken as linear in time within a step.
class FluidLedger {
 public:
  /// The account stands so at time t, s; the flow from then on begins with `flow`.
  void begin(double t, const MassAccount& account, const MassFlow& flow);
  /// A step has ended at time t, s, with a flow.
  void advance(double t, const MassFlow& flow);
  /// The account at a time within the last step, s.
  [[nodiscard]] MassAccount at(double t) const;

 private:
  double before_ = 0, now_ = 0;
  MassFlow flow_before_, flow_now_;
  MassAccount account_before_, account_now_;
};

}  // namespace polybed::fluid
