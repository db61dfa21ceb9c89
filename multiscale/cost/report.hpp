// What a sweep leaves: cost.json, cost.csv, cost.md.
#pragma once

#include <filesystem>
#include <string>

#include "multiscale/cost/sweep.hpp"

namespace polybed::multiscale {

/// \param case_text  the resolved case   \param where  case file and settings of the command line
struct SweepOf {
  std::string case_path, case_text;
  std::vector<std::string> overrides;
};

[[nodiscard]] std::string sweep_json(const Sweep& sweep, const SweepOf& of);
[[nodiscard]] std::string sweep_csv(const Sweep& sweep);
[[nodiscard]] std::string sweep_markdown(const Sweep& sweep, const SweepOf& of);

/// All three, and the picture if Python is there. Returns what it said if it is not.
[[nodiscard]] std::string write_sweep(const Sweep& sweep, const SweepOf& of, const std::filesystem::path& directory,
                                      bool picture);

}  // namespace polybed::multiscale
