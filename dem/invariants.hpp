// Invariants of particles and the fluid between them over a run: energy, number, mass of the fluid.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/coupling/fluid_record.hpp"
#include "dem/measures.hpp"
#include "measures/invariants.hpp"

namespace polybed::dem {

/// Reference for the laws: the state at the start of a run.
struct RunStart {
  double energy = 0;                 ///< J, Totals::sum()
  std::vector<std::int64_t> number;  ///< of particles in the box, by species
};

/// Particles in the box, by species, on all ranks. Collective.
[[nodiscard]] std::vector<std::int64_t> numbers_of(const Model& model);

void write(const RunStart& start, core::Checkpoint& checkpoint);
/// For a continued run; uses the present number if the checkpoint has none. Collective; reads the first rank's
/// checkpoint.
[[nodiscard]] RunStart read_run_start(const core::Checkpoint& checkpoint, const Model& model);

/// Monitors the laws over a run.
class Invariants {
 public:
  /// \param ledger  the energy is counted and is one of the laws
  Invariants(const Model& model, RunStart start, bool ledger);

  /// Measures and keeps the worst values. Collective, with the same result on every rank.
  /// \param number  present result of numbers_of()  \param fluid  null without one
  void see(const Totals& now, const std::vector<std::int64_t>& number, const FluidRecord* fluid);

  /// Data that a continued run cannot measure again, for its checkpoint, and their restoration.
  [[nodiscard]] core::Json past() const;
  void recall(const core::Json& past);

  [[nodiscard]] const RunStart& start() const { return start_; }
  [[nodiscard]] const std::vector<measures::WorstInvariant>& worst() const { return worst_; }
  /// The energy of the ledger; null without one.
  [[nodiscard]] const measures::WorstInvariant* energy() const { return ledger_ ? &worst_.front() : nullptr; }

 private:
  [[nodiscard]] double energy_miss(const Totals& now);

  const Model& model_;
  RunStart start_;
  bool ledger_;
  double greatest_energy_ = 0;  ///< so far, J
  std::vector<measures::WorstInvariant> worst_;
};

}  // namespace polybed::dem
