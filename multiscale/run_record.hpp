// run.json: what a run was, what it did, and how it stands.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/output/json.hpp"
#include "core/timers.hpp"
#include "measures/invariants.hpp"
#include "multiscale/effects/left_out.hpp"
#include "multiscale/effects/neglected.hpp"
#include "tfm/observers.hpp"

namespace polybed::multiscale {

/// The record of a run, run.json. Throws FileError if there is none, or of another version.
[[nodiscard]] core::Json read_run_record(const std::filesystem::path& directory);

/// What the ranks of a run have done together.
struct RunTotals {
  int ranks = 1;
  double cpu_seconds = 0;
  double wall_seconds = 0;  ///< by the clock of the first rank
  std::vector<tfm::ClosureUse> closures;
  std::vector<double> masses;         ///< of the species in the column, kg
  std::vector<fluid::Passed> passed;  ///< through open ends; empty if there are none
};

/// Collective.
/// \param cpu_seconds  of this process
/// \param wall_seconds  likewise, by the clock
[[nodiscard]] RunTotals totals_of(const tfm::Model& model, double cpu_seconds, double wall_seconds);

/// Everything that goes into the record; borrowed for the call.
struct RunRecord {
  const core::Scene& scene;
  const tfm::Model& model;
  const tfm::Observers& observers;
  const core::Timers& timers;
  std::string state;  ///< running | done | stopped by the user | failed: ...
  double begin;       ///< simulated time at which this process began, s
  RunTotals totals;
  const LeftOut& left_out;
  const Neglected* promise = nullptr;                 ///< what a monitor has seen; null without one
  std::vector<std::string> warnings;                  ///< its own
  std::function<void(core::Json&)> write_prediction;  ///< writes its own member
};

/// The processor's name as the system gives it; "unknown" elsewhere.
[[nodiscard]] std::string processor();

/// Writes "size_classes": what became of the species with a distribution; nothing if there is none.
void write_size_classes(core::Json& json, const core::Scene& scene);

/// Begins a record with what is the same for both models: program, case, machine.
void begin_record(core::Json& json, const core::Scene& scene, const std::string& model, const std::string& state,
                  int ranks);

/// Writes "invariants": the worst value of each, its limit, when it was, whether it held, and whether a run that breaks
/// it ends.
void write_invariants(core::Json& json, std::span<const measures::WorstInvariant> worst);

/// One line for each invariant that is beyond its limit: what the warnings of a record begin with.
[[nodiscard]] std::vector<std::string> exceeded_lines(std::span<const measures::WorstInvariant> worst);

/// Writes "timers": seconds by term.
void write_timers(core::Json& json, const core::Timers& timers);

/// One line for each height that still drifts.
[[nodiscard]] std::vector<std::string> drift_lines(const measures::Drifts& drifts);

/// The record as one JSON object.
[[nodiscard]] std::string run_record_text(const RunRecord& record);

}  // namespace polybed::multiscale
