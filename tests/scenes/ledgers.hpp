// What crosses the ends and sides of a column, for tests: its ledger, and steps past the times at which it jumps.
#pragma once

#include <algorithm>
#include <vector>

#include "measures/invariants.hpp"
#include "scenes/beds.hpp"

namespace polybed::scenes {

/// Of each species at the time of the model, m3.
inline std::vector<double> volumes(tfm::Model& model) {
  model.show(model.time());
  return measures::species_volumes(model.constants().grid, model.fields().solids);
}

/// Largest relative error of the ledgers of the species in the state that the model shows.
inline double ledger_error(const tfm::Model& model, const std::vector<double>& start) {
  const std::vector<double> now = measures::species_volumes(model.constants().grid, model.fields().solids);
  const std::vector<fluid::Passed> passed = model.passed();
  double worst = 0;
  for (std::size_t j = 0; j < now.size(); ++j)
    worst = std::max(worst, measures::ledger_error(start[j], passed[j].in, passed[j].out, now[j]));
  return worst;
}

/// Steps to a time, as a run does: past each breakpoint of what flows in by a restart.
inline void advance_past_breakpoints(tfm::Model& model, double until) {
  while (model.time() < until) {
    double stop = until;
    for (const double breakpoint : model.breakpoints())
      if (breakpoint > model.time()) stop = std::min(stop, breakpoint);
    while (model.time() < stop) model.step(stop);
    model.restart();
  }
  model.show(until);
}

}  // namespace polybed::scenes
