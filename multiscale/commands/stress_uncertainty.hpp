// polybed tfm --stress-uncertainty: what the standard errors of a stress table mean for the bed.
#pragma once

#include "core/scene.hpp"
#include "multiscale/commands/options.hpp"

namespace polybed::multiscale {

/// After a run of the case with its table: runs it with the table at plus and minus one standard error, in `plus` and
/// `minus` of its directory, and writes stress_uncertainty.json. Throws core::CaseError if the case has no table.
void run_stress_uncertainty(const RunOptions& options);

/// Throws core::CaseError if the case has no table to move.
void require_table(const core::Scene& scene);

}  // namespace polybed::multiscale
