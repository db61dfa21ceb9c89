// polybed effects: which effects a scene calls for, with the number that decides each; nothing is run.
#include <fmt/format.h>

#include "core/case_file.hpp"
#include "multiscale/commands/options.hpp"
#include "multiscale/effects/audit.hpp"
#include "multiscale/effects/bench.hpp"
#include "multiscale/effects/conflicts.hpp"
#include "multiscale/effects/effects_text.hpp"
#include "multiscale/roles.hpp"

namespace polybed::multiscale {

void run_effects(const CaseOptions& options) {
  const core::Scene scene = core::read_case(options.case_path, options.overrides, all_roles(), size_classes);
  refuse_role_conflicts(scene, options.case_path);
  const Choice choice = choose(scene);
  if (!options.json) return fmt::print("{}", effects_table(scene, choice));
  core::Json json;
  json.begin_object();
  write_effects(json, scene, choice);
  json.end_object();
  fmt::print("{}\n", json.text());
}

void run_effects_bench(int rounds, bool as_json) {
  const std::vector<EffectCost> costs = bench_effects(rounds);
  if (!as_json) return fmt::print("{}", bench_table(costs));
  core::Json json;
  json.begin_object();
  write_bench(json, costs);
  json.end_object();
  fmt::print("{}\n", json.text());
}

core::ExitCode run_effects_audit(const std::filesystem::path& run, bool as_json) {
  const Neglected neglected = audit_run(run);
  if (as_json) {
    core::Json json;
    json.begin_object().member("run", run.string());
    write_neglected(json, neglected);
    json.end_object();
    fmt::print("{}\n", json.text());
  } else {
    const char* said = !neglected.kept()   ? "not to be told: all that was met is beyond the laws' range"
                       : *neglected.kept() ? "kept"
                                           : "broken";
    fmt::print("{}the promise, {:.2g} of the weight for 99 of 100 particles, is {}\n", neglected_table(neglected),
               neglected.tolerance(), said);
  }
  return neglected.kept().value_or(false) ? core::ExitCode::done : core::ExitCode::numerics;
}

}  // namespace polybed::multiscale
