// What polybed-hard takes on its command line, and what it does with it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace polybed::hard {

struct Options {
  std::string suite = "ci";          ///< ci | full
  std::string only, schemes, naive;  ///< lists by commas; empty: all cases, all schemes, no textbook treatment
  std::filesystem::path output = "runs/stability";
  int jobs = 1;
  std::uint64_t draws = 0, seed = 1;  ///< of --fuzz: scenes drawn in the place of the catalogue
  std::vector<std::uint64_t> draw;    ///< of --draw: these alone, by their numbers
  double cpu = 2;                     ///< s that a drawn scene may compute
  bool oracles = false, json = false;
};

/// Runs the catalogue. Returns `numerics` if a cell differs from its expected outcome.
core::ExitCode run_matrix(const Options& options);
/// Runs the drawn scenes of --fuzz and --draw. Returns `numerics` if one fails.
core::ExitCode run_drawn(const Options& options);
/// Prints the numbers of the program that tests/unit/python/cost_test.py examines.
core::ExitCode run_oracles();

}  // namespace polybed::hard
