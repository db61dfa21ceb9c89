#include "app/study_request.hpp"

#include <nlohmann/json.hpp>

#include "app/run_directory.hpp"
#include "core/error.hpp"
#include "multiscale/python_module.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::app {

core::Json common_request(const RunOptions& options, const std::string& kind) {
  return {{"case", options.case_path.string()},
          {"overrides", options.overrides},
          {"until", options.until},
          {"directory", run_directory(options, kind).string()},
          {"resume", options.resume},
          {"force", options.force},
          {"permissive", options.permissive},
          {"output", options.output.string()},
          {"stress_uncertainty", options.stress_uncertainty},
          {"quiet", options.quiet},
          {"json", options.json},
          {"picture", options.picture}};
}

void run_closure_uncertainty(const RunOptions& options, const std::string& kind, const Models& models,
                             const std::string& method) {
  const core::Scene scene = read_scene(options, models);
  if (!scene.drag().given) throw core::CaseError("--closure-uncertainty is that of a drag law: [effects] drag = ...");
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  core::Json json = common_request(options, kind);
  json.update({{"kind", kind},
               {"method", method},
               {"law", scene.drag().name},
               {"partition", scene.partition().name},
               {"fluid", {{"density", fluid.density}, {"viscosity", fluid.viscosity}}}});
  become_python("polybed.study.closure_uncertainty", {core::json_text(json)});
}

void require_table(const core::Scene& scene) {
  if (!core::law_of(scene, "solids_stress").starts_with("table:"))
    throw core::CaseError("--stress-uncertainty is that of a table: effects.solids_stress = \"table:FILE\"");
}

void run_stress_uncertainty(const RunOptions& options) {
  require_table(read_scene(options, {&rules_of_tfm()}));
  become_python("polybed.study.stress_uncertainty", {core::json_text(common_request(options, "tfm"))});
}

}  // namespace polybed::app
