// Requests to the studies in the Python package: the options of a command as a JSON object, and the commands for it.
#pragma once

#include <string>

#include "app/options.hpp"
#include "app/studies.hpp"
#include "core/case/scene.hpp"
#include "core/output/json.hpp"
#include "multiscale/scene_rules.hpp"

namespace polybed::app {

/// Options for the study's runs.
/// \param kind  of the study's folder: runs/<case name>-<kind> unless -o names another
[[nodiscard]] core::Json common_request(const RunOptions& options, const std::string& kind);

/// Becomes the study that repeats polybed inversion or tfm with the case's drag law and with the law moved within its
/// band. Throws core::CaseError if the case has no drag law.
/// \param kind  "inversion" or "tfm"  \param models  that run the case  \param method  for the inversion
[[noreturn]] void run_closure_uncertainty(const RunOptions& options, const std::string& kind, const Models& models,
                                          const std::string& method = "");

/// Becomes the study that runs the case with its stress table, and with the table at plus and minus one standard error
/// in `plus` and `minus` of the run's directory, and writes stress_uncertainty.json. Throws as require_table does.
[[noreturn]] void run_stress_uncertainty(const RunOptions& options);

/// Throws core::CaseError if the case has no table for it.
void require_table(const core::Scene& scene);

}  // namespace polybed::app
