// run.json: common parts of both models' records.
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

/// Writes "size_classes": the species with a distribution and their classes; nothing if there is none.
void write_size_classes(core::Json& json, const core::Scene& scene);

/// Starts a record with the common parts for both models: program, case, machine.
void begin_record(core::Json& json, const core::Scene& scene, const std::string& model, const std::string& state,
                  int ranks);

/// Writes "invariants": the worst value of each, its limit, its time, whether it was satisfied, and whether a violation
/// ends the run.
void write_invariants(core::Json& json, std::span<const measures::WorstInvariant> worst);

/// One line for each invariant beyond its limit, for the start of a record's warnings.
[[nodiscard]] std::vector<std::string> exceeded_lines(std::span<const measures::WorstInvariant> worst);

/// Writes "timers": seconds by term.
void write_timers(core::Json& json, const core::Timers& timers);

}  // namespace polybed::multiscale
