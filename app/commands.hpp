// Command-line options and action of each command.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <type_traits>
#include <vector>

#include "app/options.hpp"
#include "app/studies.hpp"
#include "core/error.hpp"

namespace polybed::app {

/// The ranks that a command uses. Starting MPI takes 0.3 s, which commands that only compute a number avoid. A study
/// continues in the first process alone, without MPI, and starts its runs on the same number of ranks.
enum class On { one_process, first_rank, all_ranks, study };

struct Command {
  const CLI::App* app;
  std::function<core::ExitCode()> run;
  std::function<On()> on = [] { return On::one_process; };  ///< called once the line is read
};
using Commands = std::vector<Command>;

/// \param act  action of the command; one that returns nothing ends with core::ExitCode::done
template <class Act>
std::function<core::ExitCode()> doing(Act act) {
  if constexpr (std::is_void_v<decltype(act())>)
    return [act] {
      act();
      return core::ExitCode::done;
    };
  else
    return act;
}

void add_tfm(CLI::App& app, Commands& commands);
void add_dem(CLI::App& app, Commands& commands);
void add_compare(CLI::App& app, Commands& commands);
void add_plot(CLI::App& app, Commands& commands);
void add_report(CLI::App& app, Commands& commands);
void add_watch(CLI::App& app, Commands& commands);

/// Creates a case from a template.
void add_new(CLI::App& app, Commands& commands);
void add_check(CLI::App& app, Commands& commands);
void add_effects(CLI::App& app, Commands& commands);
void add_estimate(CLI::App& app, Commands& commands);
void add_drag(CLI::App& app, Commands& commands);
void add_measure(CLI::App& app, Commands& commands);
/// schema, explain, list.
void add_keys(CLI::App& app, Commands& commands);

void add_cost(CLI::App& app, Commands& commands);
void add_fit(CLI::App& app, Commands& commands);
void add_inversion(CLI::App& app, Commands& commands);
void add_ask(CLI::App& app, Commands& commands);
void add_calibrate(CLI::App& app, Commands& commands);
void add_resolve(CLI::App& app, Commands& commands);
void add_stability(CLI::App& app, Commands& commands);
void add_validate(CLI::App& app, Commands& commands);

/// Adds CASE, --set and --json.
void take_case(CLI::App& command, CaseOptions& options, bool required = true);
/// Adds a command that runs a case with the named model.
CLI::App& add_run(CLI::App& app, const std::string& model, const std::string& help, RunOptions& options);

}  // namespace polybed::app
