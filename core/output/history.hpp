// history.csv: quantities of the whole run, one row per history time.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/output/files.hpp"

namespace polybed::core {

class HistoryWriter {
 public:
  /// Starts history.csv in an existing run directory, or continues it. The first column is the time.
  /// \param resume_time  empty: a new file. Else s: removes later rows and a row cut short. Throws FileError, also if
  /// the file to continue has other columns.
  HistoryWriter(const std::filesystem::path& run_directory, std::vector<std::string> columns,
                std::optional<double> resume_time = std::nullopt);

  /// Adds a row, with the shortest digits that read back to the same bits. An entry without value (no interface
  /// visible) stays empty. The row goes to the operating system at once and complete: a killed program loses none.
  /// Throws NumericsError, and writes nothing, if a value is not finite.
  void write_row(std::span<const std::optional<double>> row);
  /// Makes the rows survive a power cut. Throws FileError.
  void flush();

 private:
  std::vector<std::string> columns_;
  LineFile file_;
};

/// A table of numbers by column; entries without value are NaN.
struct History {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> values;  ///< [column][row]

  /// A column by name, or null.
  [[nodiscard]] const std::vector<double>* find(const std::string& column) const;
  /// The same; throws FileError if there is none.
  [[nodiscard]] const std::vector<double>& of(const std::string& column) const;
};

/// Reads history.csv. Leaves out a last row that was cut short; throws FileError for other entries that are no number.
[[nodiscard]] History read_history(const std::filesystem::path& run_directory);

}  // namespace polybed::core
