// history.csv: what a run measures as a whole, one row per history time.
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
  /// Starts history.csv in a run directory that exists, or goes on with it. The first column is the time.
  /// \param resume_time  empty: a new file. Else s: rows later than that, and a row cut short, are removed.
  /// Throws FileError, also if the file that it goes on with has other columns.
  HistoryWriter(const std::filesystem::path& run_directory, std::vector<std::string> columns,
                std::optional<double> resume_time = std::nullopt);

  /// Adds a row; the shortest digits that read back to the same bits. An entry without value (no interface in
  /// sight) stays empty. The row goes to the operating system at once and whole: a killed program loses none.
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

/// Reads history.csv; a last row that was cut short is left out, anything else that is no number is a FileError.
[[nodiscard]] History read_history(const std::filesystem::path& run_directory);

}  // namespace polybed::core
