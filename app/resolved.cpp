// polybed check --resolved: the case as a record of its run has it, and whether each model runs it; nothing is
// estimated.
#include "app/run_directory.hpp"
#include "core/case/file.hpp"
#include "core/output/json.hpp"
#include "core/print.hpp"
#include "core/version.hpp"
#include "dem/continuum_scene.hpp"
#include "tfm/particle_scene.hpp"

namespace polybed::multiscale {

namespace {

/// Hash of a case without what the runs of a scan for the inversion velocity differ in: velocity, start, end and
/// output.
std::string hash_of_scanned(core::Scene scene) {
  scene.inlet.superficial_velocity = {};
  scene.bed.start = {};
  scene.run.until = 1;
  scene.output = {};
  return core::text_hash(core::resolved_case(scene));
}

/// Why a model cannot run the case; an empty list if it can.
void write_reasons(core::Json& json, const char* model, const std::vector<std::string>& reasons) {
  json.key(model).begin_array();
  for (const std::string& reason : reasons) json.value(reason);
  json.end_array();
}

}  // namespace

void print_resolved(const RunOptions& options) {
  const core::Scene scene = read_scene(options);
  const std::string text = core::resolved_case(scene);
  if (!options.json) return core::print("{}\n", text);
  core::Json json;
  json.begin_object()
      .member("git_commit", core::git_commit())
      .member("case", text)
      .member("hash", core::text_hash(text));
  json.member("scan_hash", hash_of_scanned(scene)).key("overrides").begin_array();
  for (const std::string& override : scene.overrides) json.value(override);
  json.end_array().key("refused").begin_object();
  write_reasons(json, "tfm", tfm::only_for_particles(scene));
  write_reasons(json, "dem", dem::only_for_continuum(scene));
  core::print("{}\n", json.end_object().end_object().text());
}

}  // namespace polybed::multiscale
