// Commands that run many cases to learn something.
#include "app/commands.hpp"

namespace polybed::command_line {

void add_cost(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<multiscale::CostOptions>();
  CLI::App& command = *app.add_subcommand("cost", "error against time for a case, and the settings that follow");
  command.add_option("WORDS", options->words, "CASE; check DIR; diff OLD NEW; selftest")->required();
  take_overrides(command, *options);
  command.add_option("-o,--output", options->output, "folder; default runs/<case name>-cost");
  command.add_option("--until", options->until, "simulated time, e.g. \"20 s\"");
  command.add_option("--model", options->model, "tfm | dem")->check(CLI::IsMember({"tfm", "dem"}));
  command.add_option("--qoi", options->quantities, "quantities by commas; the first ranks");
  command.add_option("--axes", options->axes, "axes by commas");
  command.add_option("--target", options->target, "error, e.g. 1%");
  command.add_option("--budget", options->budget, "wall time, e.g. 20min");
  command.add_option("--repeat", options->repeat, "runs for a CPU time")->check(CLI::Range(3, 100));
  command.add_option("--clock", options->clock, "work | cpu | wall")->check(CLI::IsMember({"work", "cpu", "wall"}));
  command.add_option("--reference", options->reference, "auto | exact | DIR of a run");
  command.add_option("--seed", options->seed, "of the order of repetitions");
  command.add_flag("--resume", options->resume, "go on with the runs in the folder");
  command.add_flag("--force", options->force, "replace a sweep that exists");
  command.add_flag("--quiet", options->quiet, "no progress");
  command.add_flag("--json", options->json, "cost.json on standard output");
  command.add_flag("!--no-picture", options->picture, "no cost.png and cost.svg");
  commands.push_back({&command, doing([options] { return multiscale::run_cost(*options); })});
}

void add_inversion(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<multiscale::InversionOptions>();
  CLI::App& command =
      *app.add_subcommand("inversion", "the inversion point of two species: by force balance, or by a scan of runs");
  take_case(command, *options);
  command.add_option("--law", options->law, "drag law in place of the case's");
  command.add_option("--temperature", options->temperature, "in place of the case's, e.g. \"20 degC\"");
  command.add_option("--method", options->method, "force_balance | bulk_density | expansion | density_maximum | all");
  command.add_option("--scan", options->scan, "by runs instead: tfm | dem | both")
      ->check(CLI::IsMember({"tfm", "dem", "both"}));
  command.add_option("--from", options->from, "lowest velocity of the first bracket, e.g. \"30 mm/s\"");
  command.add_option("--to", options->to, "highest; default a quarter about the force balance");
  command.add_option("-o,--output", options->output, "folder of a scan; default runs/<case name>-inversion");
  command.add_option("--until", options->until, "simulated time of each run, e.g. \"20 s\"");
  command.add_flag("--stress-uncertainty", options->stress_uncertainty,
                   "of a scan by the TFM: again with its stress table at plus and minus one standard error");
  command.add_flag("--permissive", options->permissive, "runs of a scan go on where a conservation law is broken");
  command.add_flag("--quiet", options->quiet, "no line for each run");
  command.add_flag("!--no-picture", options->picture, "no inversion.png at the end");
  commands.push_back({&command, doing([options] { multiscale::run_inversion(*options); }),
                      [options] { return options->scan.empty() ? On::one_process : On::all_ranks; }});
}

/// Its options are those of python/polybed/calibration, `polybed calibrate --help` included.
void add_calibrate(CLI::App& app, Commands& commands) {
  CLI::App& command = *app.add_subcommand(
      "calibrate", "run boxes of particles and make a table of the solids stress for the two-fluid model");
  command.prefix_command();
  command.set_help_flag();
  commands.push_back(
      {&command, doing([&command] { return multiscale::run_calibrate(command.remaining()); }),
       [&command] { return multiscale::calibrate_needs_mpi(command.remaining()) ? On::all_ranks : On::one_process; }});
}

/// Its options are those of polybed-hard, `polybed stability --help` included.
void add_stability(CLI::App& app, Commands& commands) {
  CLI::App& command = *app.add_subcommand("stability", "hard cases against every scheme: what held, cell by cell");
  command.prefix_command();
  command.set_help_flag();
  commands.push_back({&command, doing([&command] { multiscale::run_stability(command.remaining()); })});
}

}  // namespace polybed::command_line
