// What a scan for the inversion velocity has found, by one model or by both: as a table and as inversion.json.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "multiscale/inversion/models.hpp"
#include "multiscale/inversion/scan.hpp"

namespace polybed::multiscale {

/// A run of a scan with what its folder tells.
struct RunOfScan {
  std::filesystem::path directory;
  bool reused = false;  ///< finished before
  ScanMean mean;
  double bed_height = 0, bed_height_error = 0;  ///< time mean and half-width, m
  double begin = 0, end = 0;                    ///< of the window, s
  double cpu_seconds = 0;
  std::string integrator, git_commit;  ///< of its record
  std::vector<std::string> drifts;     ///< what is not steady
};

struct ScanOfModel {
  std::string model;  ///< tfm | dem
  ScanResult result;
  std::vector<RunOfScan> runs;  ///< as in the result
  /// Scans of the same range with the case's table of the solids stress at minus and plus one standard error; empty
  /// where that was not asked for.
  std::vector<ScanOfModel> moved;
};

/// Between which velocities a scan's answer lies with its table moved by one standard error; empty unless each of the
/// three has found one.
struct StressBand {
  double low = 0, high = 0;  ///< m/s
};
[[nodiscard]] std::optional<StressBand> stress_band(const ScanOfModel& scan);

/// Whether the models agree: relative difference of the velocities, against the greater of 5 % and half of what both
/// are unknown by (calibration.md, section 8). Empty unless both have found one.
struct ScanAgreement {
  double difference = 0, error = 0, goal = 0.05;
};
[[nodiscard]] std::optional<ScanAgreement> agreement_of(const std::vector<ScanOfModel>& scans);

/// What was asked for: all that a command line needs to make the same scan again, and what the case itself says.
struct ScanRequest {
  std::string case_file, case_hash;  ///< of the case without what a scan varies
  std::vector<std::string> overrides, species;
  std::filesystem::path directory;
  std::optional<InversionPoint> force_balance;
  std::string models;  ///< tfm | dem | both
  ScanRange range;     ///< --from and --to, or what stood in their place, m/s
  double until = 0;    ///< simulated time of each run, s
  int ranks = 1;
};

/// inversion.json.
[[nodiscard]] std::string scan_json(const std::vector<ScanOfModel>& scans, const ScanRequest& request);

/// The head of the table, its line of a run, and what was found.
[[nodiscard]] std::string scan_head();
[[nodiscard]] std::string scan_line(const std::string& model, const ScanRun& run, const RunOfScan& of_run,
                                    const std::optional<double>& from);
[[nodiscard]] std::string scan_findings(const std::vector<ScanOfModel>& scans, const ScanRequest& request);

}  // namespace polybed::multiscale
