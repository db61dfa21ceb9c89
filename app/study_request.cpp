#include "app/study_request.hpp"

#include "app/run_directory.hpp"

namespace polybed::multiscale {

core::Json begin_request(const RunOptions& options, const std::string& kind) {
  core::Json json;
  json.begin_object().member("case", options.case_path.string()).key("overrides").begin_array();
  for (const std::string& override : options.overrides) json.value(override);
  json.end_array().member("until", options.until).member("directory", run_directory(options, kind).string());
  json.member("resume", options.resume).member("force", options.force).member("permissive", options.permissive);
  json.member("stress_uncertainty", options.stress_uncertainty);
  json.member("quiet", options.quiet).member("json", options.json).member("picture", options.picture);
  return json;
}

}  // namespace polybed::multiscale
