// The matrix of hard cases: which cells are asked for, what came of each, and what was expected.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "hard/hard_case.hpp"

namespace polybed::hard {

/// What of the catalogue is run.
struct Choice {
  bool all = false;                       ///< also what is left for runs on demand
  std::vector<std::string> only = {};     ///< ids of cases, a case by its first word too; empty: every case
  std::vector<std::string> schemes = {};  ///< of the product; empty: every scheme
  std::vector<std::string> naive = {};    ///< textbook treatments, or "all"; none: the product alone
};

/// One case under one treatment.
struct Cell {
  HardCase one;
  Treatment treatment;
  Result result = {};
  double cost = 0;  ///< CPU time over that of the cheapest scheme of the case that passes; 0: nothing to compare
  std::string expected = {};  ///< outcome and what is beyond its limit; empty: nothing is written down

  [[nodiscard]] std::string found() const {
    return name_of(result.outcome) + (result.broken.empty() ? "" : ", " + result.broken);
  }
  [[nodiscard]] bool as_expected() const { return found() == expected; }
  /// A textbook treatment of a hard case has to fail.
  [[nodiscard]] bool proves_hardness() const {
    return treatment.naive.empty() || result.outcome == Outcome::fail || result.outcome == Outcome::refused;
  }
};

/// The cells of a choice; throws core::CaseError where it names what there is not.
[[nodiscard]] std::vector<Cell> cells_of(const std::vector<HardCase>& cases, const Choice& choice);

/// case and treatment -> outcome, and what is beyond its limit.
using Expected = std::map<std::pair<std::string, std::string>, std::string>;
/// Of a table with a header and rows case,treatment,outcome,broken. Throws core::FileError.
[[nodiscard]] Expected read_expected(const std::filesystem::path& path);
/// The committed table, beside the sources or where the program was installed.
[[nodiscard]] std::filesystem::path expected_path();

/// Runs the cells in child processes; one that crashes or does not end has the outcome FAIL. `shown` is called as a
/// case has all its cells, with the first of them and how many there are.
void run_cells(std::vector<Cell>& cells, int jobs, const std::function<void(std::size_t, std::size_t)>& shown);

}  // namespace polybed::hard
