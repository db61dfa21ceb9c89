// Rows of text that the program writes and reads back: history.csv, steps.csv and boxes.csv. A row counts only if it is
// complete: with its line end, all its cells, and finite numbers. A full disk or a power cut leaves incomplete ones.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace polybed::core {

/// The complete lines of a text, without their line ends.
[[nodiscard]] std::vector<std::string_view> whole_lines(std::string_view text);

/// Cells between commas; a cell in quotes can contain commas.
[[nodiscard]] std::vector<std::string_view> cells_of_row(std::string_view line);

/// The number that a text consists of, if it is finite.
[[nodiscard]] std::optional<double> finite_number(std::string_view text);

/// Called with the cells and the line of every row in a table over time, whose first line names the columns. The first
/// cell is a finite number; others can be empty, or texts in quotes. Throws FileError with the number of an incomplete
/// line; leaves out a last one without its line end.
using SeeRow = std::function<void(const std::vector<std::string_view>& cells, std::string_view line)>;
void see_rows(std::string_view text, const std::filesystem::path& path, const SeeRow& see);

/// The initial content of a table of rows in time: its header and, if the run continues, the rows up to a time. Throws
/// FileError as see_rows(), or if the columns differ.
/// \param header  with its line end
[[nodiscard]] std::string kept_rows(const std::filesystem::path& path, const std::string& header,
                                    std::optional<double> time);

/// A row with a checksum as its last cell.
[[nodiscard]] std::string with_check(const std::string& row);

/// A row without its checksum; nothing if the checksum is wrong.
[[nodiscard]] std::optional<std::string> without_check(std::string_view row);

}  // namespace polybed::core
