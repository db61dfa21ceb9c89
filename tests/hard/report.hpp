// The matrix of hard cases as people and programs read it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "hard/matrix.hpp"

namespace polybed::hard {

/// What stands above the lines of all cases on the screen, and what the outcomes below mean.
[[nodiscard]] std::string table_heading();
[[nodiscard]] std::string meaning_of_outcomes();
/// The lines of one case: what it is, then for each treatment the outcome, the furthest invariant over its limit, the
/// least step and the cost over that of the cheapest scheme that passes.
[[nodiscard]] std::string table_lines(std::span<const Cell> cells);
/// Every cell that is not as expected, and every textbook treatment that passes, a line each; empty if there is none.
[[nodiscard]] std::vector<std::string> differences(std::span<const Cell> cells);
/// How many cells of the product, and of textbook treatments, have each outcome.
[[nodiscard]] std::string summary(std::span<const Cell> cells);

/// Writes stability.json, stability.csv, stability.md, and outcomes.csv in the form of the table of what is expected.
void write_files(std::span<const Cell> cells, const std::string& suite, const std::filesystem::path& directory);

}  // namespace polybed::hard
