#include "app/closure_uncertainty.hpp"

#include <nlohmann/json.hpp>

#include "app/run_directory.hpp"
#include "app/study_request.hpp"
#include "core/error.hpp"
#include "multiscale/python_module.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::app {

void run_closure_uncertainty(const RunOptions& options, const std::string& kind, const std::string& method) {
  const core::Scene scene = read_scene(options);
  if (!scene.effects.contains("drag"))
    throw core::CaseError("--closure-uncertainty is that of a drag law: [effects] drag = ...");
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  core::Json json = common_request(options, kind);
  json.update({{"kind", kind},
               {"method", method},
               {"law", core::law_of(scene, "drag")},
               {"partition", core::law_of(scene, "partition")},
               {"fluid", {{"density", fluid.density}, {"viscosity", fluid.viscosity}}}});
  become_python("polybed.study.closure_uncertainty", {core::json_text(json)});
}

}  // namespace polybed::app
