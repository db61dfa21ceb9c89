// A sweep held to what it said: its recommendation run again, and two sweeps of one case compared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/output/json_value.hpp"

namespace polybed::multiscale {

/// A claim that was tested.
struct Checked {
  double claimed = 0, found = 0, allowed = 0;
  [[nodiscard]] bool holds() const;
};

/// Runs the recommendation of DIR/cost.json again: its error has to lie within its interval, its time within 25 %; says
/// so, and in the file. Throws core::CaseError where nothing is recommended.
[[nodiscard]] bool check_recommendation(const std::filesystem::path& directory);

/// A setting of the old sweep's front and what the same error costs in the new one.
struct Dearer {
  double error = 0, before = 0, now = 0;  ///< now: 0 where no run of the new sweep is as accurate
};

/// Of each run on the old front the cheapest run of the new sweep that is at least as accurate (to 1 % of the error),
/// where it is more than 10 % dearer. Throws core::FileError for sweeps of other cases, quantities, clocks or weights.
[[nodiscard]] std::vector<Dearer> dearer(const core::JsonValue& before, const core::JsonValue& now);

/// The same of two files, told; whether nothing is dearer.
[[nodiscard]] bool print_difference(const std::filesystem::path& before, const std::filesystem::path& now);

}  // namespace polybed::multiscale
