// polybed tfm --stress-uncertainty: what the standard errors of a stress table mean for the bed.
#pragma once

#include "app/options.hpp"
#include "app/studies.hpp"
#include "core/case/scene.hpp"

namespace polybed::app {

/// Becomes the study that runs the case with its table, and with the table at plus and minus one standard error in
/// `plus` and `minus` of the run's directory, and writes stress_uncertainty.json. Throws core::CaseError if the case
/// has no table.
[[noreturn]] void run_stress_uncertainty(const RunOptions& options);

/// Throws core::CaseError if the case has no table to move.
void require_table(const core::Scene& scene);

}  // namespace polybed::app
