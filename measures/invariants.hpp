// Invariants of the averaged equations: mass, bounds, volume, force balance.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/numerics/field.hpp"
#include "core/numerics/reduction.hpp"
#include "core/output/json.hpp"
#include "fluid/fluid_state.hpp"
#include "fluid/interphase.hpp"
#include "fluid/openings.hpp"

namespace polybed::measures {

/// The state of the invariants at one time.
struct InvariantValues {
  double mass_error = 0;      ///< largest relative change of a species' mass since the start, including in- and outflow
  double fraction_below = 0;  ///< how far the least phi_j lies below 0
  double most_solids = 0;     ///< greatest phi
  double packing_above = 0;   ///< how far the greatest phi lies above the maximum packing
  double divergence = 0;      ///< max |div J| h / U
  double fluid_error = 0;     ///< compressible fluid: relative change of its mass that is not flow
  double force_balance = 0;   ///< pressure drop over buoyant weight per area, less 1
};

/// Values that the invariants are computed from: for a block or, after a reduction, for the column.
struct Watched {
  std::vector<double> volume;  ///< of each species, m3
  double fraction_below = 0;   ///< the others as in InvariantValues
  double most_solids = 0;
  double packing_above = 0;
  double divergence = 0;

  /// \param packing_above  from the solids stress of the block  \param velocity_scale  U, m/s
  Watched(const core::Grid& grid, const fluid::Interphase& solids, const fluid::FluidState& fluid, double packing_above,
          double velocity_scale);
  void put_into(core::Reduction& all);
};

/// Worst value of an invariant so far, with time and place, and its limit.
struct WorstInvariant {
  std::string name;
  double limit = 0;
  bool judged = false;         ///< a conservation law: a run that violates it ends, unless it is permissive
  std::string remedy = {};     ///< what to do if a law is violated
  double value = 0, time = 0;  ///< time in s
  std::string place = {};      ///< empty if it has no place

  /// Keeps a value that is worse than the worst so far.
  void keep(double now, double at, const std::string& where = {});
  [[nodiscard]] double share() const;
  /// The law is violated by far, not just beyond its limit.
  [[nodiscard]] bool broken() const { return judged && !(value <= broken_above * limit); }
  /// Describes the problem: time, place, value, limit, and what to do.
  [[nodiscard]] std::string text() const;

  static constexpr double broken_above = 10;  ///< limits
};

/// The violated law that is furthest beyond its limit; null if none is violated.
[[nodiscard]] const WorstInvariant* broken_law(std::span<const WorstInvariant> worst);

/// The worst values by name, for a checkpoint, and their restoration: a continued run includes them.
[[nodiscard]] core::Json past_of(std::span<const WorstInvariant> worst);
void recall(std::span<WorstInvariant> worst, const core::Json& past);

/// Watches the invariants over a run.
class Invariants {
 public:
  /// \param initial_mass  of each species, any unit; a species without mass is not monitored
  /// \param species  their names
  /// \param rtol          relative tolerance of the time integration: sets the bounds of the fractions
  /// \param compressible  monitor the mass of the fluid instead of the divergence of the volume flux
  Invariants(std::vector<double> initial_mass, std::vector<std::string> species, double rtol,
             bool compressible = false);

  /// Measures the invariants and keeps the worst values.
  /// \param column       over all ranks  \param density  of each species, kg/m3
  /// \param passed       amount of each species that has passed open ends; empty: none
  /// \param fluid_error  in the mass of a compressible fluid; else 0
  InvariantValues see(const Watched& column, std::span<const double> density, double force_balance, double time,
                      std::span<const fluid::Passed> passed = {}, double fluid_error = 0);

  [[nodiscard]] const std::vector<double>& initial_mass() const { return initial_mass_; }
  [[nodiscard]] const std::vector<WorstInvariant>& worst() const { return worst_; }
  /// Restores the worst values of the run that this one continues.
  void recall(const core::Json& past) { measures::recall(worst_, past); }
  /// The invariant nearest to, or furthest beyond, its limit.
  [[nodiscard]] const WorstInvariant& nearest() const;

 private:
  std::vector<double> initial_mass_;
  std::vector<std::string> species_;
  bool compressible_;
  std::vector<WorstInvariant> worst_;
};

/// Error in a species' mass balance: mass now minus mass at the start, plus outflow, minus inflow, relative to the
/// start plus inflow. Masses in kg.
[[nodiscard]] double ledger_error(double start, double in, double out, double now);

/// Volume of each species in the column, m3, summed with compensation. Collective.
[[nodiscard]] std::vector<double> species_volumes(const core::Grid& grid, const fluid::Interphase& solids);

}  // namespace polybed::measures
