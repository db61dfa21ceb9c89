#include "core/output/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <system_error>

#include "core/error.hpp"

namespace polybed::core {

namespace {

namespace fs = std::filesystem;

std::string joined(const std::vector<std::string>& columns) { return fmt::format("{}\n", fmt::join(columns, ",")); }

/// The lines that end, so that one cut short is left out; without their ends.
std::vector<std::string_view> whole_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return lines;
}

std::vector<std::string_view> entries(std::string_view line) {
  std::vector<std::string_view> parts;
  for (std::size_t end = line.find(','); end != std::string_view::npos; end = line.find(',')) {
    parts.push_back(line.substr(0, end));
    line.remove_prefix(end + 1);
  }
  parts.push_back(line);
  return parts;
}

double number(std::string_view entry, const fs::path& path) {
  if (entry.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  const auto [end, error] = std::from_chars(entry.data(), entry.data() + entry.size(), value);
  if (error != std::errc() || end != entry.data() + entry.size())
    throw FileError(fmt::format("{}: '{}' is no number", path.string(), entry));
  return value;
}

/// What the file begins with: its header, and what an earlier part of the run has written up to a time. Throws
/// FileError if its columns are others.
std::string kept_text(const fs::path& path, const std::string& header, std::optional<double> time) {
  if (!time || !fs::exists(path)) return header;
  const std::string text = read_text(path);
  const auto lines = whole_lines(text);
  if (lines.empty()) return header;
  if (std::string(lines.front()) + "\n" != header)
    throw FileError(path.string() + " has other columns: it cannot be continued");
  std::string kept = header;
  for (std::size_t n = 1; n < lines.size(); ++n)
    if (number(entries(lines[n]).front(), path) <= *time) kept += std::string(lines[n]) + "\n";
  return kept;
}

}  // namespace

HistoryWriter::HistoryWriter(const fs::path& run_directory, std::vector<std::string> columns,
                             std::optional<double> resume_time)
    : columns_(std::move(columns)),
      file_(run_directory / "history.csv", kept_text(run_directory / "history.csv", joined(columns_), resume_time)) {}

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

const std::vector<double>& History::of(const std::string& column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  if (found == columns.end()) throw FileError("history.csv has no column " + column);
  return values[std::size_t(found - columns.begin())];
}

History read_history(const fs::path& run_directory) {
  const fs::path path = run_directory / "history.csv";
  const std::string text = read_text(path);
  const auto lines = whole_lines(text);
  if (lines.empty()) throw FileError(path.string() + " has no header");
  History history;
  for (const auto name : entries(lines.front())) history.columns.emplace_back(name);
  history.values.resize(history.columns.size());
  for (std::size_t n = 1; n < lines.size(); ++n) {
    const auto parts = entries(lines[n]);
    if (parts.size() != history.columns.size())
      throw FileError(fmt::format("{}: line {} has {} entries, not {}", path.string(), n + 1, parts.size(),
                                  history.columns.size()));
    for (std::size_t c = 0; c < parts.size(); ++c) history.values[c].push_back(number(parts[c], path));
  }
  return history;
}

}  // namespace polybed::core
