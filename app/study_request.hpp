// Requests to the studies of the Python package, the options of a command as a JSON object, and what becomes a study.
#pragma once

#include <string>

#include "app/options.hpp"
#include "app/studies.hpp"
#include "core/case/scene.hpp"
#include "core/output/json.hpp"
#include "multiscale/scene_rules.hpp"

namespace polybed::app {

/// The options of the runs that the study makes.
/// \param kind  of the study's folder: runs/<case name>-<kind> unless -o names another
[[nodiscard]] core::Json common_request(const RunOptions& options, const std::string& kind);

/// Becomes the study that finds the answer of polybed inversion or tfm with the case's drag law and with the law moved
/// within its band. Throws core::CaseError if the case has no drag law.
/// \param kind  "inversion" or "tfm"  \param models  that run the case  \param method  of the inversion
[[noreturn]] void run_closure_uncertainty(const RunOptions& options, const std::string& kind, const Models& models,
                                          const std::string& method = "");

/// Becomes the study that runs the case with its stress table, and with the table at plus and minus one standard error
/// in `plus` and `minus` of the run's directory, and writes stress_uncertainty.json. Throws as require_table does.
[[noreturn]] void run_stress_uncertainty(const RunOptions& options);

/// Throws core::CaseError if the case has no table to move.
void require_table(const core::Scene& scene);

}  // namespace polybed::app
