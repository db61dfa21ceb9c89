#include "core/output/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <system_error>

#include "core/error.hpp"
#include "core/output/files.hpp"

namespace polybed::core {

namespace {

bool is_quoted(std::string_view cell) { return cell.size() > 1 && cell.front() == '"' && cell.back() == '"'; }

bool is_whole_cell(std::string_view cell) { return cell.empty() || is_quoted(cell) || finite_number(cell).has_value(); }

std::string check_of(std::string_view row) {
  return fmt::format("{:08x}", crc32(std::as_bytes(std::span(row.data(), row.size()))));
}

}  // namespace

std::vector<std::string_view> whole_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return lines;
}

std::vector<std::string_view> cells_of_row(std::string_view line) {
  std::vector<std::string_view> cells;
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t n = 0; n < line.size(); ++n) {
    if (line[n] == '"') quoted = !quoted;
    if (line[n] != ',' || quoted) continue;
    cells.push_back(line.substr(begin, n - begin));
    begin = n + 1;
  }
  cells.push_back(line.substr(begin));
  return cells;
}

std::optional<double> finite_number(std::string_view text) {
  double value = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (text.empty() || error != std::errc() || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

void see_rows(std::string_view text, const std::filesystem::path& path, const SeeRow& see) {
  const auto lines = whole_lines(text);
  const std::size_t columns = lines.empty() ? 0 : cells_of_row(lines.front()).size();
  for (std::size_t n = 1; n < lines.size(); ++n) {
    const std::vector<std::string_view> cells = cells_of_row(lines[n]);
    const auto wrong = [&](const std::string& what) {
      throw FileError(
          fmt::format("{}:{}: {}: the file is damaged; restore it from a copy", path.string(), n + 1, what));
    };
    if (cells.size() != columns) wrong(fmt::format("{} cells, the header has {}", cells.size(), columns));
    const auto cell = std::find_if_not(cells.begin(), cells.end(), is_whole_cell);
    if (cell != cells.end() || !finite_number(cells.front()))
      wrong(fmt::format("'{}' is no finite number", cell != cells.end() ? *cell : cells.front()));
    see(cells, lines[n]);
  }
}

std::string kept_rows(const std::filesystem::path& path, const std::string& header, std::optional<double> time) {
  if (!time || !std::filesystem::exists(path)) return header;
  const std::string text = read_text(path);
  if (text.find('\n') == std::string::npos) return header;
  if (!text.starts_with(header))
    throw FileError(path.string() +
                    " has other columns: an earlier build wrote it: run again, or begin from its checkpoint with "
                    "bed.start = \"checkpoint:FILE\"");
  std::string kept = header;
  see_rows(text, path, [&](const auto& cells, std::string_view line) {
    if (*finite_number(cells.front()) <= *time) kept.append(line).push_back('\n');
  });
  return kept;
}

std::string with_check(const std::string& row) { return row + "," + check_of(row); }

std::optional<std::string> without_check(std::string_view row) {
  const std::size_t comma = row.rfind(',');
  if (comma == std::string_view::npos || row.substr(comma + 1) != check_of(row.substr(0, comma))) return std::nullopt;
  return std::string(row.substr(0, comma));
}

}  // namespace polybed::core
