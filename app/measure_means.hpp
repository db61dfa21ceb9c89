// Means over time as JSON: of runs, and of numbers that are given.
#pragma once

#include "app/options.hpp"
#include "core/output/json.hpp"
#include "measures/window.hpp"

namespace polybed::app {

/// Adds what a run has measured in a window of its time, and a run beside it in the same one.
/// \param beside  null: none. Without it and without a begin of the window, a history too short for one adds null
void add_means(core::Json& json, const MeasureOptions& options, const measures::StoredRun& run,
               const measures::StoredRun* beside);

/// Means and deviations of series, and ratios of sums, with their intervals. Throws core::FileError.
[[nodiscard]] core::Json means_of_series(const core::Json& asked);

}  // namespace polybed::app
