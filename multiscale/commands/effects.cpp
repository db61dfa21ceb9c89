// polybed effects: which effects a scene calls for, with the number that decides each; nothing is run.
#include <fmt/format.h>

#include "core/case_file.hpp"
#include "multiscale/commands/options.hpp"
#include "multiscale/effects/effects_text.hpp"
#include "multiscale/roles.hpp"

namespace polybed::multiscale {

void run_effects(const CaseOptions& options) {
  const core::Scene scene = core::read_case(options.case_path, options.overrides, all_roles(), size_classes);
  const Choice choice = choose(scene);
  if (!options.json) return fmt::print("{}", effects_table(scene, choice));
  core::Json json;
  json.begin_object();
  write_effects(json, scene, choice);
  json.end_object();
  fmt::print("{}\n", json.text());
}

}  // namespace polybed::multiscale
