// polybed effects: which effects a scene calls for, with the number that decides each; nothing is run.
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "core/print.hpp"
#include "multiscale/effects/audit.hpp"
#include "multiscale/effects/effects_text.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/scene_rules.hpp"

namespace polybed::app {

namespace {

struct EffectsOptions {
  CaseOptions scene;
  std::string audited;
  bool audit_json = false, details = false;
};

void run_effects(const CaseOptions& options, bool details) {
  const core::Scene scene = read_case(options.case_path, options.overrides, either_model());
  const relevance::Choice choice = choose(scene);
  if (!options.json) return core::print("{}", effects_table(scene, choice, details));
  core::Json json;
  write_effects(json, scene, choice);
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

core::ExitCode run_effects(const EffectsOptions& options, bool audit) {
  if (audit) return run_effects_audit(options.audited, options.audit_json);
  if (options.scene.case_path.empty()) throw core::CaseError("effects: name a CASE, or audit RUN");
  run_effects(options.scene, options.details);
  return core::ExitCode::done;
}

}  // namespace

void add_effects(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<EffectsOptions>();
  CLI::App& command =
      *app.add_subcommand("effects", "which effects the scene calls for, with the number that decides each");
  take_case(command, options->scene, false);
  command.add_flag("--details", options->details, "the reason of every row");
  command.require_subcommand(0, 1);
  CLI::App* audit = command.add_subcommand(
      "audit", "what a run has left out, evaluated on all that it stored; code 3 if that exceeds the bound");
  audit->add_option("RUN", options->audited, "run directory")->required();
  audit->add_flag("--json", options->audit_json, "one JSON object");
  commands.push_back({&command, [options, audit] { return run_effects(*options, audit->parsed()); }});
}

}  // namespace polybed::app
