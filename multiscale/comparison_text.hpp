// A comparison as it is written and shown.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/output/json_value.hpp"
#include "multiscale/compare.hpp"

namespace polybed::multiscale {

/// What the comparison says of one of its runs.
struct ComparedRun {
  std::filesystem::path directory;
  core::JsonValue record;  ///< its run.json
};

/// What was compared, as it was asked for.
struct ComparisonRequest {
  std::string case_file;
  std::vector<std::string> overrides;  ///< --set
  std::filesystem::path directory;     ///< of the comparison
};

/// comparison.json.
[[nodiscard]] std::string comparison_json(const Comparison& comparison, const ComparedRun& tfm, const ComparedRun& dem,
                                          const ComparisonRequest& request);

/// The same as tables for the screen.
[[nodiscard]] std::string comparison_table(const Comparison& comparison, const ComparedRun& tfm,
                                           const ComparedRun& dem);

}  // namespace polybed::multiscale
