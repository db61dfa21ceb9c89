// What the command line says, as plain data: filled by main, read by the commands.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
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
  std::filesystem::path output;  ///< empty: runs/<case name>-<model>
  std::string until;             ///< empty: as the case says
  bool resume = false, force = false, quiet = false;
  bool permissive = false;           ///< goes on where a conservation law is broken
  bool picture = true;               ///< drawn at the end
  bool details = false;              ///< the numerics too, of a run and of polybed check
  bool closure_uncertainty = false;  ///< again with its drag law moved within its band
  bool stress_uncertainty = false;   ///< of the TFM: again with its stress table at plus and minus one standard error
};

/// Options of the pictures of a run.
struct PlotOptions {
  std::filesystem::path run;     ///< a run directory, or a case that has one in runs/
  std::string what = "all";      ///< overview | fields | particles | profiles | history | animation, by commas; or all
  std::string time;              ///< empty: the last one stored
  std::filesystem::path output;  ///< empty: RUN/pictures
  std::string format = "png";    ///< png | svg
  double rate = 0;               ///< frames per second; 0: chosen
  bool quiet = false, json = false;
};

/// Options of the page that follows a run.
struct WatchOptions {
  std::filesystem::path run;  ///< a run directory, or a case that has one in runs/
  int port = 0;               ///< on the loopback address; 0: any that is free
};

/// Options of the estimate of what a run will take.
struct EstimateOptions : CaseOptions {  // case_path may be empty
  std::string model;                    ///< tfm | dem; empty: the continuum where it runs the case
  std::string probe;                    ///< CPU time; empty: none
  int ranks = 1;
  bool machine = false;  ///< measure the machine
};

/// Options of what is read off profiles: one of the first three is given.
struct MeasureOptions {
  std::filesystem::path run;  ///< a run directory
  std::string profiles;       ///< a JSON file of profiles; "-": standard input
  bool list = false;          ///< the measures themselves
  bool markdown = false, json = false, csv = false;
};

struct DragOptions {
  std::string law = "cello", partition = "none", csv;
  std::optional<double> voidage, reynolds;
  bool guard = true, json = false;
};

/// Options of the inversion point; those of a run are for the runs of a scan.
struct InversionOptions : RunOptions {
  std::string law, partition, temperature, method = "force_balance";
  std::string scan;          ///< tfm | dem | both; empty: without a run
  bool seen = false;         ///< also with what particles see
  bool composition = false;  ///< a table over the share of the second species
  std::string from, to;      ///< velocities to begin the scan at; empty: about the force balance
};

struct MoveOptions {
  std::filesystem::path table, moved;
  double sigma = 0;  ///< standard errors
};

/// Options of drag data from resolved flow.
struct ResolveOptions : CaseOptions {
  std::filesystem::path output;  ///< empty: runs/<case name>-resolve
  bool resume = false, force = false, quiet = false, estimate = false;
};

/// Each command writes its answer to standard output; errors are thrown.
void run_tfm(const RunOptions& options);
void run_dem(const RunOptions& options);
[[noreturn]] void run_compare(const std::vector<std::string>& words);
void run_check(const RunOptions& options);
/// The case alone, as a record of its run has it; as JSON with its hashes and why a model cannot run it.
void print_resolved(const RunOptions& options);
void run_effects(const CaseOptions& options, bool details);
void run_effects_bench(int rounds, bool json);
/// The code to end with: of numbers that failed where the promise is broken.
core::ExitCode run_effects_audit(const std::filesystem::path& run, bool json);
void run_estimate(const EstimateOptions& options);
void run_drag(const DragOptions& options);
void run_resolve(const ResolveOptions& options);
void run_measure(const MeasureOptions& options);
void run_inversion(const InversionOptions& options);
/// Writes a table of the solids stress moved by a number of its standard errors; for studies.
void run_move_table(const MoveOptions& options);
[[noreturn]] void run_inversion_scan(const InversionOptions& options);
void run_schema(bool json, bool markdown);
void run_explain(const std::string& word, bool json);
void run_list(bool json, bool details);
/// Templates and shipped cases with what each shows and how long it takes.
void run_list_cases(bool json);
/// Writes NAME/case.toml, with the files that it reads.
void run_new(const std::filesystem::path& name, const std::string& from);
/// Becomes the study in Python, or serves it. \param words  its options
core::ExitCode run_calibrate(const std::vector<std::string>& words);
/// Whether these words are run by all ranks.
[[nodiscard]] bool calibrate_needs_mpi(const std::vector<std::string>& words);
/// Becomes polybed-hard, installed beside the program. \param words  its options
[[noreturn]] void run_stability(std::vector<std::string> words);
/// The code to end with: what is wrong has been said by the module that draws.
core::ExitCode run_plot(const PlotOptions& options);
/// Makes report.html of a run; of the options only the run is read.
core::ExitCode run_report(const PlotOptions& options);
/// Becomes the server of the page that follows a run. Throws core::FileError.
[[noreturn]] void run_watch(const WatchOptions& options);

}  // namespace polybed::app
