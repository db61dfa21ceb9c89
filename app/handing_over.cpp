// Commands that hand over to another program.
#include <fmt/format.h>

#include "app/commands.hpp"
#include "multiscale/program.hpp"
#include "multiscale/python_module.hpp"

namespace polybed::app {

namespace {

/// A command that passes all its options on to the program that does its work, --help included.
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
  add_study(app, commands, "cost", "error against time for a case, and the settings that follow",
            "polybed.cost.command", On::one_process);
}

void add_fit(CLI::App& app, Commands& commands) {
  add_study(app, commands, "fit", "fit a drag law to rows of resolved flow, and write a law file",
            "polybed.fit.command", On::one_process);
}

void add_validate(CLI::App& app, Commands& commands) {
  add_study(app, commands, "validate", "measured beds against the models: runs, verdicts, a page",
            "polybed.validation.command", On::study);
}

void add_calibrate(CLI::App& app, Commands& commands) {
  add_study(app, commands, "calibrate",
            "run boxes of particles and make a table of the solids stress for the two-fluid model",
            "polybed.calibration.command", On::study);
}

void add_stability(CLI::App& app, Commands& commands) {
  CLI::App& command = add_handed_over(app, "stability", "hard cases against every scheme: what held, cell by cell");
  commands.push_back({&command, doing([&command] { become_stability(command.remaining()); })});
}

}  // namespace polybed::app
