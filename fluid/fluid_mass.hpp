// The mass of a compressible fluid in the column, and its inflow and outflow.
#pragma once

#include "fluid/boundaries.hpp"
#include "fluid/fluid_state.hpp"

namespace polybed::fluid {

/// Mass flow, kg/s: in through the distributor and inflow parts of the sides, out through the outlet and outflow parts
/// of the sides.
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

/// Mass in the column at the start, and mass that has passed its ends since, kg.
struct MassAccount {
  double start = 0, in = 0, out = 0;
  /// (start + in - out - stored) relative to the larger of start and inflow.
  [[nodiscard]] double error(double stored) const;
};

/// Integrates the account over steps; the flow is taken as linear in time within a step.
class FluidLedger {
 public:
  /// Starts with this account and flow at time t, s.
  void begin(double t, const MassAccount& account, const MassFlow& flow);
  /// Ends a step at time t, s, with this flow.
  void advance(double t, const MassFlow& flow);
  /// The account at a time within the last step, s.
  [[nodiscard]] MassAccount at(double t) const;

 private:
  double before_ = 0, now_ = 0;
  MassFlow flow_before_, flow_now_;
  MassAccount account_before_, account_now_;
};

}  // namespace polybed::fluid
