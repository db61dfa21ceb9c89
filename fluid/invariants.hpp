// What must hold at any time, measured on the averages: mass, bounds, volume, force balance.
#pragma once

#include <string>
#include <vector>

#include "core/field.hpp"
#include "fluid/fluid_state.hpp"
#include "fluid/interphase.hpp"

namespace polybed::fluid {

/// The state of the invariants at one time.
struct InvariantValues {
  double mass_error = 0;      ///< largest relative change of a species' mass since the start
  double fraction_below = 0;  ///< how far the least phi_j lies below 0
  double most_solids = 0;     ///< greatest phi
  double packing_above = 0;   ///< how far the greatest phi lies above the maximum packing
  double divergence = 0;      ///< max |div J| h / U
  double fluid_error = 0;     ///< of a compressible fluid: what its mass has changed by without flowing, relative
  double force_balance = 0;   ///< pressure drop over buoyant weight per area, less 1
};

/// Largest value an invariant has had, where it was, against its limit.
struct WorstInvariant {
  std::string name;
  double value = 0, limit = 0, time = 0;
  [[nodiscard]] double share() const { return limit > 0 ? value / limit : 0; }
};

/// Watches the invariants over a run.
class Invariants {
 public:
  /// \param initial_mass  of each species, any unit; a species without mass is not watched
  /// \param rtol          relative tolerance of the time integration: sets the bounds of the fractions
  /// \param compressible  the mass of the fluid is watched in place of the divergence of the volume flux
  Invariants(std::vector<double> initial_mass, double rtol, bool compressible = false);

  /// Measures and keeps what is worst in the column. Collective.
  /// \param fluid_error  of the mass of a compressible fluid; else 0
  InvariantValues see(const core::Grid& grid, const Interphase& solids, const FluidState& fluid, double packing_above,
                      double velocity_scale, double force_balance, double time, double fluid_error = 0);

  [[nodiscard]] const std::vector<WorstInvariant>& worst() const { return worst_; }
  /// The invariant nearest to, or furthest beyond, its limit.
  [[nodiscard]] const WorstInvariant& nearest() const;

 private:
  void keep(std::size_t which, double value, double time);

  std::vector<double> initial_mass_;
  bool compressible_;
  std::vector<WorstInvariant> worst_;
};

/// Volume of each species in the column, m3, summed with compensation. Collective.
[[nodiscard]] std::vector<double> species_volumes(const core::Grid& grid, const Interphase& solids);

}  // namespace polybed::fluid
