// run.json: what the records of both models share.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/output/json.hpp"
#include "core/timers.hpp"
#include "measures/invariants.hpp"

namespace polybed::multiscale {

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

}  // namespace polybed::multiscale
