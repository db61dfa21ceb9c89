// What particles and the fluid between them must keep over a run: their energy, their number, the mass of the fluid.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/coupling/fluid_record.hpp"
#include "dem/measures.hpp"
#include "measures/invariants.hpp"

namespace polybed::dem {

/// What the laws are checked against: the state at the start of a run.
struct RunStart {
  double energy = 0;                 ///< J, Totals::sum()
  std::vector<std::int64_t> number;  ///< of particles in the box, by species
};

/// Particles in the box, by species, on all ranks. Collective.
[[nodiscard]] std::vector<std::int64_t> numbers_of(const Model& model);

void write(const RunStart& start, core::Checkpoint& checkpoint);
/// Of a run that goes on; the number is that of now where the checkpoint has none. Collective, the first rank's
/// checkpoint is read.
[[nodiscard]] RunStart read_run_start(const core::Checkpoint& checkpoint, const Model& model);

/// Watches the laws over a run.
class Invariants {
 public:
  /// \param ledger  the energy is counted, and so is a law
  Invariants(const Model& model, RunStart start, bool ledger);

  /// Measures and keeps what is worst. Collective, with the same result on every rank.
  /// \param number  what numbers_of() says now  \param fluid  null without one
  void see(const Totals& now, const std::vector<std::int64_t>& number, const FluidRecord* fluid);

  /// What a run that goes on cannot measure again, for its checkpoint, and the same taken up.
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
  double greatest_energy_ = 0;  ///< met so far, J
  std::vector<measures::WorstInvariant> worst_;
};

}  // namespace polybed::dem
