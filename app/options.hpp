// Command-line options as plain data, where several files read them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/studies.hpp"
#include "core/error.hpp"

namespace polybed::app {

/// Options of the commands that take a case.
struct CaseOptions {
  std::filesystem::path case_path;
  std::vector<std::string> overrides;
  bool json = false;
};

/// Options of a run.
struct RunOptions : CaseOptions {
  std::filesystem::path output;                         ///< empty: runs/<case name>-<model>
  std::string until;                                    ///< empty: from the case
  static constexpr std::string_view steady = "steady";  ///< instead of a time
  [[nodiscard]] bool until_steady() const { return until == steady; }
  bool resume = false, force = false, quiet = false;
  bool permissive = false;           ///< continues after a violation of a conservation law
  bool picture = true;               ///< drawn at the end
  bool details = false;              ///< also the numerics, for a run and for polybed check
  bool closure_uncertainty = false;  ///< repeats the run with its drag law moved within its band
  bool stress_uncertainty = false;   ///< TFM: runs also with its stress table at plus and minus one standard error
};

/// Options for measures of runs or series: one of the first three is given.
struct MeasureOptions {
  std::filesystem::path run;  ///< a run directory
  std::string series;         ///< a JSON file of numbers; "-": standard input
  bool list = false;          ///< list the measures
  // For the means of a run.
  std::filesystem::path beside;      ///< another run, over the same window; empty: none
  std::optional<double> begin, end;  ///< of the window, s; without a begin the window is chosen
  std::size_t slabs = 0;             ///< number that profiles are converted to; 0: their own
  bool markdown = false, json = false, csv = false, details = false;
};

/// Options for the inversion point; a run's options apply to the runs of a scan.
struct InversionOptions : RunOptions {
  std::string law, partition, temperature, method = "force_balance";
  std::string scan;          ///< tfm | dem | both; empty: without a run
  bool composition = false;  ///< a table over the share of the second species
  std::string from, to;      ///< initial velocities of the scan; empty: around the force balance
};

// Commands, and parts of commands, in separate files. Each prints its answer on standard output and throws errors.
/// The case alone, as in its run's record; as JSON with its hashes and the reasons why a model cannot run it.
void print_resolved(const RunOptions& options);
/// Every measure with its unit and definition: a text, JSON, or the page of the documentation.
void print_measures(const MeasureOptions& options);
[[noreturn]] void run_inversion_scan(const InversionOptions& options);
void run_explain(const std::string& word, bool json);
/// Templates and shipped cases with their purpose and duration.
void run_list_cases(bool json);

}  // namespace polybed::app
