// Commands that run a case, or draw what was run.
#include "app/commands.hpp"

namespace polybed::app {

namespace {

/// A command that runs a case by a model of that name.
CLI::App& add_run(CLI::App& app, const std::string& model, const std::string& help, RunOptions& options) {
  CLI::App& command = *app.add_subcommand(model, help);
  take_case(command, options);
  command.add_option("-o,--output", options.output, "run directory; default runs/<case name>-" + model);
  command.add_option("--until", options.until, "simulated time, e.g. \"20 s\"");
  command.add_flag("--resume", options.resume, "go on from the checkpoint in the run directory");
  command.add_flag("--force", options.force, "replace the run in the run directory");
  command.add_flag("--permissive", options.permissive,
                   "go on where a conservation law is broken more than tenfold, which ends a run otherwise");
  command.add_flag("--details", options.details,
                   "at the end the numerics too: time by term, work, invariants, closures");
  command.add_flag("--quiet", options.quiet, "no progress");
  command.add_flag("!--no-picture", options.picture,
                   "no picture.png and no report.html at the end, which take seconds");
  return command;
}

}  // namespace

void take_overrides(CLI::App& command, CaseOptions& options) {
  command.add_option("--set", options.overrides, "KEY=VALUE, in place of what the file says")
      ->take_all()
      ->allow_extra_args(false);
}

void take_case(CLI::App& command, CaseOptions& options, bool required) {
  command.add_option("CASE", options.case_path, "the case file")->required(required);
  take_overrides(command, options);
  command.add_flag("--json", options.json, "one JSON object on standard output, nothing else there");
}

void add_tfm(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App& command = add_run(app, "tfm", "run the case as a continuum (two-fluid model)", *options);
  command.add_flag("--stress-uncertainty", options->stress_uncertainty,
                   "again with the stress table at plus and minus one standard error: the band of the bed height");
  command.add_flag("--closure-uncertainty", options->closure_uncertainty,
                   "again with the drag law moved within its band: the band of the bed height");
  commands.push_back({&command, doing([options] { run_tfm(*options); }), [options] {
                        return options->stress_uncertainty || options->closure_uncertainty ? On::study : On::all_ranks;
                      }});
}

void add_dem(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App& command = add_run(app, "dem", "run the case particle by particle", *options);
  commands.push_back({&command, doing([options] { run_dem(*options); }), [] { return On::all_ranks; }});
}

void add_plot(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<PlotOptions>();
  CLI::App& command = *app.add_subcommand("plot", "pictures of a finished or a running run");
  command.add_option("RUN", options->run, "run directory, or the case of a run in runs/")->required();
  command.add_option("--what", options->what,
                     "overview | fields | particles | profiles | history | animation, several by commas; default all");
  command.add_option("--time", options->time, "the stored time nearest to it, e.g. \"5 s\"; default the last");
  command.add_option("-o,--out,--output", options->output, "folder of the pictures; default RUN/pictures");
  command.add_option("--format", options->format, "png | svg")->check(CLI::IsMember({"png", "svg"}));
  command.add_option("--rate", options->rate, "frames per second of the animation; default: it lasts about 12 s")
      ->check(CLI::Range(0.1, 120.0));
  command.add_flag("--quiet", options->quiet, "no progress");
  command.add_flag("--json", options->json, "one JSON object: the files written");
  commands.push_back({&command, doing([options] { return run_plot(*options); })});
}

void add_report(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<PlotOptions>();
  CLI::App& command =
      *app.add_subcommand("report", "report.html of a run: one file with results, pictures and the case");
  command.add_option("RUN", options->run, "run directory, or the case of a run in runs/")->required();
  commands.push_back({&command, doing([options] { return run_report(*options); })});
}

void add_watch(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<WatchOptions>();
  CLI::App& command = *app.add_subcommand("watch", "a page that follows a run, for a browser on this machine");
  command.add_option("RUN", options->run, "run directory, or the case of a run in runs/")->required();
  command.add_option("--port", options->port, "of the page; default: any that is free")->check(CLI::Range(0, 65535));
  commands.push_back({&command, doing([options] { run_watch(*options); })});
}

}  // namespace polybed::app
