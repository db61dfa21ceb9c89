// polybed effects: which effects a scene calls for, with the number that decides each; nothing is run.
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "core/print.hpp"
#include "multiscale/effects/effects_text.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/scene_rules.hpp"

namespace polybed::app {

namespace {

struct EffectsOptions {
  CaseOptions scene;
  bool details = false;
};

void run_effects(const CaseOptions& options, bool details) {
  const core::Scene scene = read_case(options.case_path, options.overrides, either_model());
  const relevance::Choice choice = choose(scene);
  if (!options.json) return core::print("{}", effects_table(scene, choice, details));
  core::Json json;
  write_effects(json, scene, choice);
  core::print("{}\n", core::json_text(json));
}

}  // namespace

void add_effects(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<EffectsOptions>();
  CLI::App& command =
      *app.add_subcommand("effects", "which effects the scene calls for, with the number that decides each");
  take_case(command, options->scene);
  command.add_flag("--details", options->details, "the reason of every row");
  commands.push_back({&command, [options] {
                        run_effects(options->scene, options->details);
                        return core::ExitCode::done;
                      }});
}

}  // namespace polybed::app
