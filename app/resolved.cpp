// polybed check --resolved: the case as in its run's record, and whether each model runs it, without an estimate.
#include <nlohmann/json.hpp>

#include "app/run_directory.hpp"
#include "core/case/file.hpp"
#include "core/output/json.hpp"
#include "core/print.hpp"
#include "core/version.hpp"
#include "multiscale/scene_rules.hpp"

namespace polybed::app {

namespace {

/// Hash of a case without the keys that differ between runs of an inversion scan: velocity, start, end and output.
std::string hash_of_scanned(core::Scene scene) {
  scene.inlet.superficial_velocity = {};
  scene.bed.start = {};
  scene.run.until = 1;
  scene.output = {};
  return core::case_hash(scene);
}

}  // namespace

void print_resolved(const RunOptions& options) {
  const core::Scene scene = read_scene(options, either_model());
  const std::string text = core::resolved_case(scene);
  if (!options.json) return core::print("{}\n", text);
  core::print("{}\n", core::json_text({{"git_commit", core::git_commit()},
                                       {"case", text},
                                       {"hash", core::case_hash(scene)},
                                       {"scan_hash", hash_of_scanned(scene)},
                                       {"overrides", scene.overrides},
                                       {"refused", refusals_of(scene)}}));
}

}  // namespace polybed::app
