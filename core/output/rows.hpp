// Rows of text that the program writes and reads back: history.csv, steps.csv and boxes.csv. A row counts only if it is
// whole: with its line end, all its cells, and finite numbers. What a full disk or a power cut leaves is none.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace polybed::core {

/// The lines of a text that end, without their ends.
[[nodiscard]] std::vector<std::string_view> whole_lines(std::string_view text);

/// Cells between commas; commas in quotes belong to a cell.
[[nodiscard]] std::vector<std::string_view> cells_of_row(std::string_view line);

/// The number that a text is from its first to its last character, if it is finite.
[[nodiscard]] std::optional<double> finite_number(std::string_view text);

/// Sees the cells and the line of every row of a table in time, whose first line names the columns. The first cell is a
/// finite number; others may be empty, or texts in quotes. Throws FileError with the number of a line that is not
/// whole; a last one without its end is left out.
using SeeRow = std::function<void(const std::vector<std::string_view>& cells, std::string_view line)>;
void see_rows(std::string_view text, const std::filesystem::path& path, const SeeRow& see);

/// What a table of rows in time begins with: its header and, if the run goes on, the rows up to a time. Throws
/// FileError as see_rows(), or if the columns are others.
/// \param header  with its line end
[[nodiscard]] std::string kept_rows(const std::filesystem::path& path, const std::string& header,
                                    std::optional<double> time);

/// A row with a checksum as its last cell.
[[nodiscard]] std::string with_check(const std::string& row);

/// A row without its checksum; nothing if that does not hold.
[[nodiscard]] std::optional<std::string> without_check(std::string_view row);

}  // namespace polybed::core
