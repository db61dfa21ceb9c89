// polybed tfm --stress-uncertainty: what the standard errors of a stress table mean for the bed.
#pragma once

#include "app/options.hpp"
#include "core/case/scene.hpp"

namespace polybed::multiscale {

/// Writes the table of a scene, moved by a number of its standard errors, as directory/table-NAME.h5. Collective.
/// Returns what to set in the case so that it is read.
[[nodiscard]] std::string with_moved_table(const core::Scene& scene, const std::filesystem::path& directory,
                                           const std::string& name, double sigma);

/// Hash of what the file of a scene's table holds; empty if it has none.
[[nodiscard]] std::string hash_of_table(const core::Scene& scene);

/// After a run of the case with its table: runs it with the table at plus and minus one standard error, in `plus` and
/// `minus` of its directory, and writes stress_uncertainty.json. Throws core::CaseError if the case has no table.
void run_stress_uncertainty(const RunOptions& options);

/// Throws core::CaseError if the case has no table to move.
void require_table(const core::Scene& scene);

}  // namespace polybed::multiscale
