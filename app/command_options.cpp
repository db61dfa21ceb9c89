// Common command-line options of several commands.
#include "app/commands.hpp"

namespace polybed::app {

void take_case(CLI::App& command, CaseOptions& options, bool required) {
  command.add_option("CASE", options.case_path, "the case file")->required(required);
  command.add_option("--set", options.overrides, "KEY=VALUE, in place of what the file says")
      ->take_all()
      ->allow_extra_args(false);
  command.add_flag("--json", options.json, "one JSON object on standard output, nothing else there");
}

CLI::App& add_run(CLI::App& app, const std::string& model, const std::string& help, RunOptions& options) {
  CLI::App& command = *app.add_subcommand(model, help);
  take_case(command, options);
  command.add_option("-o,--output", options.output, "run directory; default runs/<case name>-" + model);
  command.add_option("--until", options.until,
                     "simulated time, e.g. \"20 s\"; steady: until the card says so, at most 20 times run.until");
  command.add_flag("--resume", options.resume, "go on from the checkpoint in the run directory");
  command.add_flag("--force", options.force, "replace the run in the run directory");
  command.add_flag("--permissive", options.permissive,
                   "go on where a conservation law is broken more than tenfold, which ends a run otherwise");
  command.add_flag("--details", options.details,
                   "at the end the numerics too: time by term, work, invariants, closures");
  command.add_flag("--quiet", options.quiet,
                   "errors alone on standard error: no progress, no warnings, no card; run.json contains them");
  command.add_flag("!--no-picture", options.picture,
                   "no picture.png and no report.html at the end, which take seconds");
  return command;
}

}  // namespace polybed::app
