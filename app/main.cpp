// The program: its command line, MPI for commands that need it, and the only place that exits.
#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "app/commands.hpp"
#include "app/process.hpp"
#include "core/case/keys.hpp"
#include "core/error.hpp"
#include "core/numerics/mpi_start.hpp"
#include "core/numerics/ranks.hpp"
#include "core/print.hpp"
#include "core/vectors.hpp"
#include "core/version.hpp"
#include "multiscale/program.hpp"

namespace polybed::app {

namespace {

/// Agreement of the ranks on how they end.
class MpiSession {
 public:
  MpiSession() {
    core::open_mpi();
    MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  }
  ~MpiSession() { core::close_mpi(); }
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  [[nodiscard]] bool first() const { return rank_ == 0; }

  /// Reports an error common to all ranks once. The others would wait forever for an error that they do not know:
  /// after some seconds the rank with the error reports it and ends them all.
  void agree_on(Ending& ending) const {
    if (ranks_ == 1 || ending.code == 0) return;
    MPI_Request all_here = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &all_here);
    for (int tenths = 0, done = 0; tenths < 50; ++tenths) {
      MPI_Test(&all_here, &done, MPI_STATUS_IGNORE);
      if (done != 0) {
        if (!first()) ending.message.clear();
        return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    core::print(stderr, "rank {}: {}\n", rank_, ending.message);
    MPI_Abort(MPI_COMM_WORLD, ending.code);
  }

 private:
  int ranks_ = 1, rank_ = 0;
};

Commands add_commands(CLI::App& app) {
  Commands commands;
  for (const auto add : {add_new,  add_tfm,    add_dem,   add_compare,   add_check,     add_effects, add_estimate,
                         add_cost, add_drag,   add_fit,   add_inversion, add_calibrate, add_resolve, add_measure,
                         add_plot, add_report, add_watch, add_stability, add_validate,  add_keys,    add_ask})
    add(app, commands);
  return commands;
}

/// The command line without the options before the command.
std::vector<std::string> words_from_command(const CLI::App& app, int argc, char** argv) {
  const std::string command = app.get_subcommands().front()->get_name();
  return {std::find(argv, argv + argc, command), argv + argc};
}

/// The error in the position of the command: suggests the nearest name for an unknown one, and -n must come before it.
/// Empty if the command is known, or if there is none.
std::string misplaced_command(const CLI::App& app, int argc, char** argv) {
  const std::string_view ranks = "-n";
  int at = 1;
  while (at < argc && argv[at][0] == '-') at += argv[at] == ranks ? 2 : 1;
  if (at >= argc) return "";
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  const std::string word = argv[at];
  if (std::find(names.begin(), names.end(), word) != names.end()) {
    const auto behind =
        std::find_if(argv + at, argv + argc, [&](std::string_view given) { return given.starts_with(ranks); });
    if (behind == argv + argc) return "";
    const std::string joined = std::string(*behind).substr(ranks.size()),
                      next = behind + 1 < argv + argc ? behind[1] : "2";
    return fmt::format("-n stands before the command: polybed -n {} {} ...", joined.empty() ? next : joined, word);
  }
  constexpr std::array<std::string_view, 2> of_others{"run", "simulate"};
  if (word.ends_with(".toml") || std::find(of_others.begin(), of_others.end(), word) != of_others.end())
    return fmt::format(
        "'{}' is no command: polybed tfm CASE runs a case as a continuum, polybed dem CASE particle by "
        "particle; polybed check CASE says which can",
        word);
  const std::string near = core::nearest_name(word, names);
  return fmt::format("unknown command '{}'{}", word,
                     near.empty() ? "; polybed --help lists them" : "; did you mean '" + near + "'?");
}

/// Checks that the output has arrived: a full disk shows only when the buffer is flushed.
void flush_standard_output() {
  if (const int reason = core::refusal_of_answer(); reason != 0)
    throw core::FileError(fmt::format("standard output: cannot be written ({})", std::strerror(reason)));
}

/// A wrong POLYBED_VECTORS ends the program here, not in the first loop.
void check_vector_width() {
  try {
    (void)core::vector_width();
  } catch (const std::invalid_argument& error) {
    throw core::CaseError(error.what());
  }
}

/// Runs the command line and returns the exit code; throws the command's errors. Reports an invalid line on standard
/// error and returns core::ExitCode::wrong_case.
/// \param mpi  started if the command needs it
core::ExitCode run(int argc, char** argv, std::optional<MpiSession>& mpi) {
  check_vector_width();
  keep_typed_program(argv[0]);
  CLI::App app{"polybed: beds of particles of several sizes and densities in a liquid or a gas"};
  const std::string kind = core::build_kind().empty() ? "" : ", built with " + core::build_kind();
  app.set_version_flag("--version", "polybed " + core::version() + " (" + core::git_commit() + ")" + kind);
  app.require_subcommand(1);
  int ranks = 1;
  app.add_option("-n", ranks, "before the command: the number of ranks that share it, by mpirun")
      ->check(CLI::Range(1, 1000000));
  const Commands commands = add_commands(app);
  if (argc == 1) {  // the name alone lists the commands
    core::print(stderr, "{}\npolybed list cases: cases to start from; polybed COMMAND --help: its options\n",
                app.help());
    return core::ExitCode::wrong_case;
  }
  if (const std::string wrong = misplaced_command(app, argc, argv); !wrong.empty()) throw core::CaseError(wrong);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked = error.get_exit_code() == 0;
    std::ostringstream answer, refusal;
    app.exit(error, answer, refusal);
    core::put(stdout, answer.str());
    core::put(stderr, refusal.str());
    if (!asked) return core::ExitCode::wrong_case;
    flush_standard_output();
    return core::ExitCode::done;
  }
  core::ExitCode code = core::ExitCode::done;
  for (const Command& command : commands) {
    if (!command.app->parsed()) continue;
    const On on = command.on();
    if (on == On::study) {
      keep_ranks_for_runs(ranks);
      if (core::first_by_launcher()) code = command.run();
      continue;
    }
    if (ranks > 1) return run_ranks(ranks, words_from_command(app, argc, argv));
    if (on != On::one_process) mpi.emplace();
    if (on != On::first_rank || mpi->first()) code = command.run();
  }
  core::on_first(mpi ? core::Ranks::of_program().get() : nullptr, flush_standard_output);
  return code;
}

}  // namespace
}  // namespace polybed::app

using namespace polybed;

int main(int argc, char** argv) {
  std::optional<app::MpiSession> mpi;
  app::Ending ending = app::guarded([&] { return app::run(argc, argv, mpi); });
  if (mpi) mpi->agree_on(ending);
  if (!ending.message.empty()) core::print(stderr, "{}\n", ending.message);
  return ending.code;
}
