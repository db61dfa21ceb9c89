// polybed plot: pictures of a finished or active run, drawn by the Python package.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/commands.hpp"
#include "app/run_directory.hpp"
#include "core/case/units.hpp"
#include "core/error.hpp"
#include "core/output/directory.hpp"
#include "core/output/files.hpp"
#include "core/print.hpp"
#include "multiscale/program.hpp"
#include "multiscale/python_module.hpp"

namespace polybed::app {

namespace {

/// Options of the pictures and the pages of a run.
struct PlotOptions {
  std::filesystem::path run;     ///< a run directory, or a case that has one in runs/
  std::string what = "all";      ///< overview | fields | particles | profiles | history | animation, by commas; or all
  std::string time;              ///< empty: the last one stored
  std::filesystem::path output;  ///< empty: RUN/pictures
  std::string format = "png";    ///< png | svg
  double rate = 0;               ///< frames per second; 0: chosen
  bool quiet = false, json = false;
  int port = 0;  ///< of the page that follows a run, on the loopback address; 0: any that is free
};

namespace fs = std::filesystem;

/// A study, such as that of polybed cost, has pictures of its own.
bool is_run(const fs::path& directory) {
  constexpr std::array names{"run.json",       "fields.h5",      "particles.h5",
                             "cost.json",      "fit.json",       "comparison.json",
                             "inversion.json", "stability.json", "closure_uncertainty.json"};
  return std::any_of(names.begin(), names.end(), [&](const char* name) { return fs::exists(directory / name); });
}

/// The run for a path: a run directory, or the run of a case file or a case's folder in runs/, the continuum's if there
/// are two.
fs::path run_of(const fs::path& given) {
  if (!fs::exists(given)) throw core::FileError(fmt::format("{}: no such run directory or case", given.string()));
  if (is_run(given)) return given;
  const bool folder = fs::is_directory(given), with_case = folder && fs::exists(given / "case.toml");
  if (folder && !with_case)
    throw core::FileError(fmt::format(
        "{}: not a run directory (it has neither run.json nor fields.h5 nor particles.h5)", given.string()));
  if (!folder && given.extension() != ".toml")
    throw core::FileError(fmt::format("{}: neither a run directory nor a case file", given.string()));
  const fs::path file = folder ? given / "case.toml" : given, run = default_run_directory(file, "tfm");
  for (const fs::path& directory : {run, default_run_directory(file, "dem")})
    if (is_run(directory)) return directory;
  throw core::FileError(fmt::format("{}: no run of it in {}; {} tfm {} makes one", given.string(), run.string(),
                                    typed_program(), core::shell_word(file.string())));
}

double time_of(const std::string& text) {
  const auto time = core::parse_quantity(text);
  if (!time || (time->has_unit && !(time->dimension == core::dimension::time)))
    throw core::CaseError(fmt::format("--time {}: expected a time, e.g. 5 or \"5 s\"", text));
  return time->value;
}

std::vector<std::string> words_of(const PlotOptions& options) {
  std::vector<std::string> words{"--what", options.what, "--format", options.format};
  if (!options.time.empty()) words.insert(words.end(), {"--time", fmt::format("{:.17g}", time_of(options.time))});
  if (!options.output.empty()) words.insert(words.end(), {"--out", options.output.string()});
  if (options.rate > 0) words.insert(words.end(), {"--rate", fmt::format("{}", options.rate)});
  if (options.quiet) words.emplace_back("--quiet");
  if (options.json) words.emplace_back("--json");
  const fs::path run = run_of(options.run);
  core::refuse_link(run / "pictures");
  words.insert(words.end(), {"--", run.string()});
  return words;
}

/// What a module that was to make something of a run has ended with. Throws core::FileError if it could not do its
/// work.
core::ExitCode code_of(const PythonEnd& end, const PlotOptions& options, const std::string& what) {
  if (!end.not_started.empty())
    throw core::FileError(fmt::format("no {}: {}; {}", what, end.not_started, python_packages));
  if (end.code > 128 && end.code != int(core::ExitCode::stopped))
    throw core::FileError(fmt::format("{}: no {}: Python was ended by signal {}; a file in it may be damaged",
                                      options.run.string(), what, end.code - 128));
  switch (end.code) {  // the module has reported the error
    case 0:
      return core::ExitCode::done;
    case int(core::ExitCode::wrong_case):
      return core::ExitCode::wrong_case;
    case int(core::ExitCode::stopped):
      return core::ExitCode::stopped;
    default:
      return core::ExitCode::file;
  }
}

core::ExitCode run_plot(const PlotOptions& options) {
  if (!options.output.empty()) core::mark_directory(options.output);
  return code_of(run_python("polybed.plot", words_of(options), PythonOutput::show), options, "pictures");
}

core::ExitCode run_report(const PlotOptions& options) {
  const PythonEnd end = run_python("polybed.report.build", {"--", run_of(options.run).string()}, PythonOutput::show);
  return code_of(end, options, "report.html");
}

void run_watch(const PlotOptions& options) {
  become_python("polybed.report.watch",
                {"--port", fmt::format("{}", options.port), "--", run_of(options.run).string()});
}

}  // namespace

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
  const auto options = std::make_shared<PlotOptions>();
  CLI::App& command = *app.add_subcommand("watch", "a page that follows a run, for a browser on this machine");
  command.add_option("RUN", options->run, "run directory, or the case of a run in runs/")->required();
  command.add_option("--port", options->port, "of the page; default: any that is free")->check(CLI::Range(0, 65535));
  commands.push_back({&command, doing([options] { run_watch(*options); })});
}

}  // namespace polybed::app
