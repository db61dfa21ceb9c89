// run.json of the continuum model: description of a run, its work, and its state.
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

/// Totals over the ranks of a run.
struct RunTotals {
  int ranks = 1;
  double cpu_seconds = 0;
  double wall_seconds = 0;  ///< on the first rank's clock
  std::vector<tfm::ClosureUse> closures;
  std::vector<double> masses;         ///< of the species in the column, kg
  std::vector<fluid::Passed> passed;  ///< through open ends; empty without any
};

/// Number of evaluations of each closure in the model, on all ranks. Collective.
/// \param before  by earlier processes
[[nodiscard]] std::vector<tfm::ClosureUse> closures_of(const tfm::Model& model,
                                                       std::span<const tfm::ClosureUse> before = {});

/// Collective.
/// \param cpu_seconds  of this process
/// \param wall_seconds  likewise, on the clock
/// \param before  as in closures_of()
[[nodiscard]] RunTotals totals_of(const tfm::Model& model, double cpu_seconds, double wall_seconds,
                                  std::span<const tfm::ClosureUse> before);

/// Contents of the record; borrowed for the call.
struct RunRecord {
  const core::Scene& scene;
  const tfm::Model& model;
  const tfm::Observers& observers;
  const core::Timers& timers;
  std::string state;  ///< running | done | stopped by the user | failed: ...
  double begin;       ///< simulated time at which this process began, s
  RunTotals totals;
  const LeftOut& left_out;
  const Neglected* promise = nullptr;           ///< observations of a monitor; null without one
  std::vector<std::string> warnings;            ///< its own
  std::function<void(core::Json&)> write_card;  ///< writes the members of the card and the prediction
};

/// The record as one JSON object.
[[nodiscard]] std::string run_record_text(const RunRecord& record);

}  // namespace polybed::multiscale
