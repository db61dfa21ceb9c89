#include "multiscale/command_line/command_line.hpp"

#include <cerrno>
#include <cstring>

#include "core/version.hpp"
#include "multiscale/command_line/commands.hpp"

namespace polybed::command_line {

namespace {

Commands add_commands(CLI::App& app) {
  Commands commands;
  for (const auto add : {add_tfm, add_dem, add_compare, add_check, add_effects, add_estimate, add_cost, add_drag,
                         add_inversion, add_calibrate, add_plot, add_stability, add_keys})
    add(app, commands);
  return commands;
}

/// What was printed has to have arrived: a full disk shows only when the buffer is emptied.
void flush_standard_output() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw core::FileError(fmt::format("standard output: cannot be written ({})", std::strerror(errno)));
}

}  // namespace

core::ExitCode run(int argc, char** argv, std::optional<MpiSession>& mpi) {
  CLI::App app{"polybed: beds of particles of several sizes and densities in a liquid or a gas"};
  const std::string kind = core::build_kind().empty() ? "" : ", built with " + core::build_kind();
  app.set_version_flag("--version", "polybed " + core::version() + " (" + core::git_commit() + ")" + kind);
  app.require_subcommand(1);
  const Commands commands = add_commands(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked = error.get_exit_code() == 0;
    app.exit(error);
    return asked ? core::ExitCode::done : core::ExitCode::wrong_case;
  }
  core::ExitCode code = core::ExitCode::done;
  for (const Command& command : commands) {
    if (!command.app->parsed()) continue;
    const On on = command.on();
    if (on != On::one_process) mpi.emplace(argc, argv);
    if (on != On::first_rank || mpi->first()) code = command.run();
  }
  flush_standard_output();
  return code;
}

}  // namespace polybed::command_line
