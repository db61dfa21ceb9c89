#include "core/output/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/output/rows.hpp"

namespace polybed::core {

namespace {

namespace fs = std::filesystem;

std::string joined(const std::vector<std::string>& columns) { return fmt::format("{}\n", fmt::join(columns, ",")); }

}  // namespace

HistoryWriter::HistoryWriter(const fs::path& run_directory, std::vector<std::string> columns,
                             std::optional<double> resume_time)
    : columns_(std::move(columns)),
      file_(run_directory / "history.csv", kept_rows(run_directory / "history.csv", joined(columns_), resume_time)) {}

void HistoryWriter::write_row(std::span<const std::optional<double>> row) {
  if (row.size() != columns_.size())
    throw std::invalid_argument(fmt::format("{} entries for {} columns", row.size(), columns_.size()));
  std::string line;
  for (std::size_t n = 0; n < row.size(); ++n) {
    if (row[n] && !std::isfinite(*row[n]))
      throw NumericsError(fmt::format("{} is {} at t = {} s: not written", columns_[n], *row[n],
                                      row[0].value_or(std::numeric_limits<double>::quiet_NaN())));
    if (n > 0) line += ',';
    if (row[n]) line += fmt::format("{}", *row[n]);
  }
  file_.append(line + "\n");
}

void HistoryWriter::flush() { file_.flush(); }

const std::vector<double>* History::find(const std::string& column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  return found == columns.end() ? nullptr : &values[std::size_t(found - columns.begin())];
}

const std::vector<double>& History::of(const std::string& column) const {
  const std::vector<double>* found = find(column);
  if (found == nullptr) throw FileError("history.csv has no column " + column);
  return *found;
}

History read_history(const fs::path& run_directory) {
  const fs::path path = run_directory / "history.csv";
  const std::string text = read_text(path);
  const auto lines = whole_lines(text);
  if (lines.empty()) throw FileError(path.string() + " has no header");
  History history;
  for (const auto name : cells_of_row(lines.front())) history.columns.emplace_back(name);
  history.values.resize(history.columns.size());
  see_rows(text, path, [&](const auto& cells, std::string_view) {
    for (std::size_t c = 0; c < cells.size(); ++c)
      history.values[c].push_back(finite_number(cells[c]).value_or(std::numeric_limits<double>::quiet_NaN()));
  });
  return history;
}

}  // namespace polybed::core
