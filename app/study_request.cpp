#include "app/study_request.hpp"

#include <nlohmann/json.hpp>

#include "app/run_directory.hpp"

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

}  // namespace polybed::app
