// polybed estimate: the cost of a run, before it.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "core/case/units.hpp"
#include "core/error.hpp"
#include "core/output/files.hpp"
#include "core/print.hpp"
#include "multiscale/estimate/estimate.hpp"
#include "multiscale/scene_rules.hpp"

namespace polybed::app {

namespace {

/// Options for estimating the cost of a run.
struct EstimateOptions : CaseOptions {  // case_path can be empty
  std::string model;                    ///< tfm | dem; empty: the continuum if it runs the case
  std::string probe;                    ///< CPU time; empty: none
  int ranks = 1;
  bool machine = false;  ///< measure the machine
};

constexpr double machine_seconds = 28;  ///< CPU

void measure_and_keep(bool as_json) {
  const std::filesystem::path path = machine_file();
  if (path.empty()) throw core::FileError("neither XDG_CACHE_HOME nor HOME says where to keep it");
  if (!as_json) core::print(stderr, "measuring for about {:.0f} s\n", machine_seconds);
  const std::string text = machine_text(measure_machine(machine_seconds));
  core::make_directories(path.parent_path());
  core::write_atomically(path, text + "\n");
  core::print("{}\n", as_json ? text : path.string());
}

double seconds_of(const std::string& text) {
  const auto time = core::parse_quantity(text);
  if (!time || (time->has_unit && !(time->dimension == core::dimension::time)) || !(time->value > 0))
    throw core::CaseError(fmt::format("--probe {}: expected a time, e.g. 5s", text));
  return time->value;
}

/// The requested models.
Models models_of(const EstimateOptions& options) {
  if (options.model.empty()) return either_model();
  return {options.model == "dem" ? &rules_of_dem() : &rules_of_tfm()};
}

/// The requested model; else the two-fluid model if it runs the case.
std::string model_of(const EstimateOptions& options, const core::Scene& scene) {
  if (!options.model.empty()) return options.model;
  return rules_of_tfm().problems(scene).empty() ? "tfm" : "dem";
}

void run_estimate(const EstimateOptions& options) {
  if (options.machine) measure_and_keep(options.json);
  if (options.case_path.empty()) {
    if (!options.machine)
      throw core::CaseError("CASE is missing: polybed estimate CASE, or polybed estimate --machine");
    return;
  }
  const core::Scene scene = read_chosen_case(options.case_path, options.overrides, models_of(options));
  const double probe = options.probe.empty() ? 0 : seconds_of(options.probe);
  const Machine machine = known_machine();
  const CostEstimate estimate = model_of(options, scene) == "dem" ? estimate_dem(scene, machine, probe, options.ranks)
                                                                  : estimate_tfm(scene, machine, probe, options.ranks);
  if (!options.json) return print_estimate(scene, estimate);
  core::Json json = {{"until_s", scene.run.until}};
  write_estimate(json, estimate);
  core::print("{}\n", core::json_text(json));
}

}  // namespace

void add_estimate(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<EstimateOptions>();
  CLI::App& command = *app.add_subcommand("estimate", "time, memory and disk of a run, and what would make it cheaper");
  take_case(command, *options, false);
  command.add_option("--model", options->model, "tfm | dem")->check(CLI::IsMember({"tfm", "dem"}));
  command.add_option("--ranks", options->ranks, "that will share the case")->check(CLI::Range(1, 1000000));
  command.add_option("--probe", options->probe, "run the case itself for so long first, e.g. 5s");
  command.add_flag("--machine", options->machine, "measure this machine (30 s) and keep what was found");
  commands.push_back({&command, doing([options] { run_estimate(*options); }), [] { return On::first_rank; }});
}

}  // namespace polybed::app
