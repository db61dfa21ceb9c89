// polybed effects: which effects a scene calls for, with the number that decides each; nothing is run.
#include <nlohmann/json.hpp>

#include "app/options.hpp"
#include "core/print.hpp"
#include "multiscale/effects/audit.hpp"
#include "multiscale/effects/bench.hpp"
#include "multiscale/effects/effects_text.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/scene_rules.hpp"

namespace polybed::app {

void run_effects(const CaseOptions& options, bool details) {
  const core::Scene scene = read_case(options.case_path, options.overrides);
  const relevance::Choice choice = choose(scene);
  if (!options.json) return core::print("{}", effects_table(scene, choice, details));
  core::Json json;
  write_effects(json, scene, choice);
  core::print("{}\n", core::json_text(json));
}

void run_effects_bench(int rounds, bool as_json) {
  const std::vector<EffectCost> costs = bench_effects(rounds);
  if (!as_json) return core::print("{}", bench_table(costs));
  core::Json json;
  write_bench(json, costs);
  core::print("{}\n", core::json_text(json));
}

core::ExitCode run_effects_audit(const std::filesystem::path& run, bool as_json) {
  const Neglected neglected = audit_run(run);
  if (as_json) {
    core::Json json = {{"run", run.string()}};
    write_neglected(json, neglected);
    core::print("{}\n", core::json_text(json));
  } else {
    const char* said = !neglected.kept()   ? "not known: all encounters are outside the range of the laws"
                       : *neglected.kept() ? "kept"
                                           : "broken";
    core::print("{}the bound, {:.2g} of the weight for 99 of 100 particles, is {}\n", neglected_table(neglected),
                neglected.tolerance(), said);
  }
  return neglected.kept().value_or(false) ? core::ExitCode::done : core::ExitCode::numerics;
}

}  // namespace polybed::app
