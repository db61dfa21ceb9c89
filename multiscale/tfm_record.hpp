// run.json of the continuum model: what a run was, what it did, and how it stands.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/output/json.hpp"
#include "core/timers.hpp"
#include "multiscale/effects/left_out.hpp"
#include "multiscale/effects/neglected.hpp"
#include "tfm/observers.hpp"

namespace polybed::multiscale {

/// What the ranks of a run have done together.
struct RunTotals {
  int ranks = 1;
  double cpu_seconds = 0;
  double wall_seconds = 0;  ///< by the clock of the first rank
  std::vector<tfm::ClosureUse> closures;
  std::vector<double> masses;         ///< of the species in the column, kg
  std::vector<fluid::Passed> passed;  ///< through open ends; empty if there are none
};

/// How often each closure of the model was evaluated, on all ranks. Collective.
/// \param before  by the processes before this one
[[nodiscard]] std::vector<tfm::ClosureUse> closures_of(const tfm::Model& model,
                                                       std::span<const tfm::ClosureUse> before = {});

/// Collective.
/// \param cpu_seconds  of this process
/// \param wall_seconds  likewise, by the clock
/// \param before  as of closures_of()
[[nodiscard]] RunTotals totals_of(const tfm::Model& model, double cpu_seconds, double wall_seconds,
                                  std::span<const tfm::ClosureUse> before);

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
  const Neglected* promise = nullptr;           ///< what a monitor has seen; null without one
  std::vector<std::string> warnings;            ///< its own
  std::function<void(core::Json&)> write_card;  ///< and the prediction: writes their members
};

/// The record as one JSON object.
[[nodiscard]] std::string run_record_text(const RunRecord& record);

}  // namespace polybed::multiscale
