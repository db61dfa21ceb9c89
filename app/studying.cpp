// Commands that run many cases to learn something.
#include <fmt/format.h>

#include "app/commands.hpp"
#include "multiscale/calibrate/moved_table.hpp"
#include "multiscale/program.hpp"
#include "multiscale/python_module.hpp"

namespace polybed::app {

namespace {

/// A command whose options are those of the program that it hands over to, --help included.
CLI::App& add_handed_over(CLI::App& app, const std::string& name, const std::string& help) {
  CLI::App& command = *app.add_subcommand(name, help);
  command.prefix_command();
  command.set_help_flag();
  return command;
}

/// One that becomes a module of the Python package.
void add_study(CLI::App& app, Commands& commands, const std::string& name, const std::string& help,
               const std::string& module, On on) {
  CLI::App& command = add_handed_over(app, name, help);
  commands.push_back({&command, [&command, module]() -> core::ExitCode { become_python(module, command.remaining()); },
                      [on] { return on; }});
}

[[noreturn]] void become_stability(std::vector<std::string> words) {
  const std::string program = (this_program().parent_path() / "polybed-hard").string();
  words.insert(words.begin(), program);
  throw core::FileError(
      fmt::format("{}: cannot be started ({}); in a build tree: cmake --build build --target polybed-hard", program,
                  become(words)));
}

}  // namespace

void add_compare(CLI::App& app, Commands& commands) {
  add_study(app, commands, "compare", "run the case by both models, or take runs of it: how far they agree",
            "polybed.study.compare", On::study);
}

void add_cost(CLI::App& app, Commands& commands) {
  add_study(app, commands, "cost", "error against time for a case, and the settings that follow", "polybed.cost",
            On::one_process);
}

void add_fit(CLI::App& app, Commands& commands) {
  add_study(app, commands, "fit", "fit a drag law to rows of resolved flow, and write a law file", "polybed.fit",
            On::one_process);
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
  struct Options {
    std::filesystem::path table, moved;
    double sigma = 0;  ///< standard errors
  };
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("move-table", "a table of the solids stress, moved by standard errors");
  command.group("");
  command.add_option("TABLE", options->table)->required();
  command.add_option("--sigma", options->sigma)->required();
  command.add_option("MOVED", options->moved)->required();
  commands.push_back(
      {&command, doing([options] { write_moved_table(options->table, options->sigma, options->moved); })});
}

void add_calibrate(CLI::App& app, Commands& commands) {
  CLI::App& command = add_handed_over(
      app, "calibrate", "run boxes of particles and make a table of the solids stress for the two-fluid model");
  commands.push_back({&command, doing([&command] { return run_calibrate(command.remaining()); }), [&command] {
                        return calibrate_needs_mpi(command.remaining()) ? On::all_ranks : On::one_process;
                      }});
}

void add_stability(CLI::App& app, Commands& commands) {
  CLI::App& command = add_handed_over(app, "stability", "hard cases against every scheme: what held, cell by cell");
  commands.push_back({&command, doing([&command] { become_stability(command.remaining()); })});
}

}  // namespace polybed::app
