// Totals of the fluid between particles since the start of a run, and its last pressure drop: stored in checkpoints, so
// that a resumed run reports all of it.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/numerics/ranks.hpp"
#include "core/output/checkpoint.hpp"
#include "dem/coupling/coupling.hpp"
#include "fluid/fluid_mass.hpp"

namespace polybed::dem {

struct FluidTotals {
  std::uint64_t steps = 0, iterations = 0;  ///< of the fluid, and of its linear solver
  double worst_residual = 0;                ///< of the pressure equation, relative
  double greatest_courant = 0;
  LawUse law;                  ///< for drag, on all ranks
  Coupling::Changes changes;   ///< in the loads within steps of the fluid, on all ranks
  double pressure_drop = 0;    ///< Pa, after the fluid's last step
  double mass = 0;             ///< of a compressible fluid in the column then, kg
  fluid::MassAccount account;  ///< for that fluid

  /// Root mean square change of the loads within a step of the fluid, over the loads' own.
  [[nodiscard]] double relative_change() const {
    return changes.force.units() > 0 ? std::sqrt(changes.change.units() / changes.force.units()) : 0;
  }
};

class FluidRecord {
 public:
  /// \param coupling  must outlive the record  \param before  totals before this process, on the first rank.
  /// Collective.
  FluidRecord(const Coupling& coupling, const core::Ranks* ranks, const FluidTotals& before);

  /// Records the fluid's step, if there was one since the last call. Call it after each step of the particles.
  void see();
  [[nodiscard]] double pressure_drop() const { return totals_.pressure_drop; }
  [[nodiscard]] double mass() const { return totals_.mass; }
  /// For a compressible fluid: relative difference of its mass from its account.
  [[nodiscard]] double mass_error() const { return totals_.account.error(totals_.mass); }
  /// Collective.
  [[nodiscard]] FluidTotals totals() const;

 private:
  void look();

  const Coupling& coupling_;
  const core::Ranks* ranks_;
  FluidTotals totals_;  ///< for the law: before this process
  std::uint64_t seen_;
  LawUse begin_;  ///< on this rank before the first step: excludes evaluations by the restart
};

void write(const FluidTotals& totals, core::Checkpoint& checkpoint);
/// From a checkpoint; initial values if it has none, as for particles without a fluid.
[[nodiscard]] FluidTotals read_fluid_totals(const core::Checkpoint& checkpoint);

}  // namespace polybed::dem
