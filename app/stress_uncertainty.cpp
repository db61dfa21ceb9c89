#include "app/stress_uncertainty.hpp"

#include <nlohmann/json.hpp>

#include "app/run_directory.hpp"
#include "app/study_request.hpp"
#include "core/error.hpp"
#include "multiscale/python_module.hpp"

namespace polybed::multiscale {

void require_table(const core::Scene& scene) {
  if (!core::law_of(scene, "solids_stress").starts_with("table:"))
    throw core::CaseError("--stress-uncertainty is that of a table: effects.solids_stress = \"table:FILE\"");
}

void run_stress_uncertainty(const RunOptions& options) {
  require_table(read_scene(options));
  become_python("polybed.study.stress_uncertainty", {core::json_text(common_request(options, "tfm"))});
}

}  // namespace polybed::multiscale
