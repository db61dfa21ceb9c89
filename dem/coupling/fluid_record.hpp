// What the fluid between the particles has taken and met since the start of a run, and its last pressure drop: kept in
// checkpoints, so that a run taken up again tells the whole.
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
  double worst_residual = 0;                ///< of the pressure's equation, relative
  double greatest_courant = 0;
  LawUse law;                  ///< of drag, on all ranks
  Coupling::Changes changes;   ///< of the loads within steps of the fluid, on all ranks
  double pressure_drop = 0;    ///< Pa, after the fluid's last step
  double mass = 0;             ///< of a compressible fluid in the column then, kg
  fluid::MassAccount account;  ///< of that fluid

  /// Root mean square of what loads change by within a step of the fluid, over that of the loads.
  [[nodiscard]] double relative_change() const {
    return changes.force.units() > 0 ? std::sqrt(changes.change.units() / changes.force.units()) : 0;
  }
};

class FluidRecord {
 public:
  /// \param coupling  must outlive the record  \param before  what a run that goes on had before, on the first rank.
  /// Collective.
  FluidRecord(const Coupling& coupling, const core::Ranks* ranks, const FluidTotals& before);

  /// Takes notice of the fluid's step, if there was one since the last call. After each step of the particles.
  void see();
  [[nodiscard]] double pressure_drop() const { return totals_.pressure_drop; }
  [[nodiscard]] double mass() const { return totals_.mass; }
  /// Of a compressible fluid: what its mass differs by from its account, relative.
  [[nodiscard]] double mass_error() const { return totals_.account.error(totals_.mass); }
  /// Collective.
  [[nodiscard]] FluidTotals totals() const;

 private:
  void look();

  const Coupling& coupling_;
  const core::Ranks* ranks_;
  FluidTotals totals_;  ///< those of the law: before this process
  std::uint64_t seen_;
  LawUse begin_;  ///< of this rank before the first step, when a run that goes on asked for nothing it needs
};

void write(const FluidTotals& totals, core::Checkpoint& checkpoint);
/// Of a checkpoint; as at a start where it has none, being of particles without a fluid.
[[nodiscard]] FluidTotals read_fluid_totals(const core::Checkpoint& checkpoint);

}  // namespace polybed::dem
