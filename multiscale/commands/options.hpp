// What the command line says, as plain data: filled by main, read by the commands.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace polybed::multiscale {

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
};

struct DragOptions {
  std::string law = "cello", csv;
  std::optional<double> voidage, reynolds;
  bool guard = true, json = false;
};

struct InversionOptions : CaseOptions {
  std::string law, temperature, method = "force_balance";
};

/// Each command writes its answer to standard output; errors are thrown.
void run_tfm(const RunOptions& options);
void run_check(const CaseOptions& options);
void run_drag(const DragOptions& options);
void run_inversion(const InversionOptions& options);
void run_schema(bool json, bool markdown);
void run_explain(const std::string& key, bool json);
void run_list(bool json);
void run_plot(const std::filesystem::path& run);

}  // namespace polybed::multiscale
