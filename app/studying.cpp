// Commands that run many cases to learn something.
#include "app/commands.hpp"
#include "multiscale/python_module.hpp"

namespace polybed::app {

/// Its options are those of the Python package, `polybed cost --help` included.
void add_cost(CLI::App& app, Commands& commands) {
  CLI::App& command = *app.add_subcommand("cost", "error against time for a case, and the settings that follow");
  command.prefix_command();
  command.set_help_flag();
  commands.push_back(
      {&command, [&command]() -> core::ExitCode { become_python("polybed.cost", command.remaining()); }});
}

/// Its options are those of the Python package, `polybed fit --help` included.
void add_fit(CLI::App& app, Commands& commands) {
  CLI::App& command = *app.add_subcommand("fit", "fit a drag law to rows of resolved flow, and write a law file");
  command.prefix_command();
  command.set_help_flag();
  commands.push_back({&command, [&command]() -> core::ExitCode { become_python("polybed.fit", command.remaining()); }});
}

void add_inversion(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<InversionOptions>();
  CLI::App& command =
      *app.add_subcommand("inversion", "the inversion point of two species: by force balance, or by a scan of runs");
  take_case(command, *options);
  command.add_option("--law", options->law, "drag law in place of the case's");
  command.add_option("--partition", options->partition,
                     "what shares it among the species in place of the case's; none");
  command.add_option("--temperature", options->temperature, "in place of the case's, e.g. \"20 degC\"");
  command.add_option("--method", options->method, "force_balance | bulk_density | expansion | density_maximum | all");
  command.add_flag("--composition", options->composition, "a table over the share of the second species");
  command.add_flag("--seen", options->seen,
                   "the force balance also with the averages that particles see, dem.own_share = kept");
  command.add_option("--scan", options->scan, "by runs instead: tfm | dem | both")
      ->check(CLI::IsMember({"tfm", "dem", "both"}));
  command.add_option("--from", options->from, "lowest velocity of the first bracket, e.g. \"30 mm/s\"");
  command.add_option("--to", options->to, "highest; default a quarter about the force balance");
  command.add_option("-o,--output", options->output, "folder of a scan; default runs/<case name>-inversion");
  command.add_option("--until", options->until, "simulated time of each run, e.g. \"20 s\"");
  command.add_flag("--stress-uncertainty", options->stress_uncertainty,
                   "of a scan by the TFM: again with its stress table at plus and minus one standard error");
  command.add_flag("--closure-uncertainty", options->closure_uncertainty,
                   "of the force balance: with the band of its drag law; -o DIR keeps record and picture");
  command.add_flag("--permissive", options->permissive, "runs of a scan go on where a conservation law is broken");
  command.add_flag("--quiet", options->quiet, "no line for each run");
  command.add_flag("!--no-picture", options->picture, "no inversion.png and inversion.html at the end");
  commands.push_back({&command, doing([options] { run_inversion(*options); }), [options] {
                        return options->scan.empty() && !options->closure_uncertainty ? On::one_process : On::study;
                      }});
}

/// For the package's own use.
void add_move_table(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<MoveOptions>();
  CLI::App& command = *app.add_subcommand("move-table", "a table of the solids stress, moved by standard errors");
  command.group("");
  command.add_option("TABLE", options->table)->required();
  command.add_option("--sigma", options->sigma)->required();
  command.add_option("MOVED", options->moved)->required();
  commands.push_back({&command, doing([options] { run_move_table(*options); })});
}

/// Its options are those of python/polybed/calibration, `polybed calibrate --help` included.
void add_calibrate(CLI::App& app, Commands& commands) {
  CLI::App& command = *app.add_subcommand(
      "calibrate", "run boxes of particles and make a table of the solids stress for the two-fluid model");
  command.prefix_command();
  command.set_help_flag();
  commands.push_back({&command, doing([&command] { return run_calibrate(command.remaining()); }), [&command] {
                        return calibrate_needs_mpi(command.remaining()) ? On::all_ranks : On::one_process;
                      }});
}

/// Its options are those of polybed-hard, `polybed stability --help` included.
void add_stability(CLI::App& app, Commands& commands) {
  CLI::App& command = *app.add_subcommand("stability", "hard cases against every scheme: what held, cell by cell");
  command.prefix_command();
  command.set_help_flag();
  commands.push_back({&command, doing([&command] { run_stability(command.remaining()); })});
}

}  // namespace polybed::app
