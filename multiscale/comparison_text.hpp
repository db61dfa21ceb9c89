// A comparison as it is written and shown.
#pragma once

#include <filesystem>
#include <string>

#include "core/json_value.hpp"
#include "multiscale/compare.hpp"

namespace polybed::multiscale {

/// What the comparison says of one of its runs.
struct ComparedRun {
  std::filesystem::path directory;
  core::JsonValue record;  ///< its run.json
};

/// comparison.json. \param case_file  as given
[[nodiscard]] std::string comparison_json(const Comparison& comparison, const ComparedRun& tfm, const ComparedRun& dem,
                                          const std::string& case_file);

/// The same as tables for the screen.
[[nodiscard]] std::string comparison_table(const Comparison& comparison, const ComparedRun& tfm,
                                           const ComparedRun& dem);

}  // namespace polybed::multiscale
