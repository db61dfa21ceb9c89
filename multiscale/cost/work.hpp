// What a run has done, weighed: a clock that gives the same time on every run and every machine.
#pragma once

#include <map>
#include <string>

#include "core/output/json_value.hpp"

namespace polybed::multiscale {

/// Of the weights below: numbers weighed by other versions are not to be compared.
constexpr int work_version = 1;

/// Counters of a run, by the names of run.json; those that grow with the case are multiplied by its size.
using Counters = std::map<std::string, double>;

/// The counters of a run's record. \param cells  of the fluid of a run of particles
[[nodiscard]] Counters counters_of(const core::JsonValue& record, double cells);

/// Their sum, s, each with its weight. What has none, such as the number of steps, does not count.
[[nodiscard]] double weighed(const Counters& counters);

}  // namespace polybed::multiscale
