// Reads the reference tables: CSV with '#' comments, a header, and cells in quotes.
#pragma once

#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace polybed::test {

class Table {
 public:
  explicit Table(const std::string& name) {
    std::ifstream file(std::string(POLYBED_TEST_DATA) + "/" + name);
    if (!file) throw std::runtime_error("no table " + name);
    for (std::string line; std::getline(file, line);) {
      while (!line.empty() && line.back() == '\r') line.pop_back();
      if (line.empty() || line[0] == '#') continue;
      const std::vector<std::string> cells = split(line);
      if (place_.empty())
        for (std::size_t n = 0; n < cells.size(); ++n) place_[cells[n]] = n;
      else
        rows_.push_back(cells);
    }
  }
  [[nodiscard]] std::size_t rows() const { return rows_.size(); }
  [[nodiscard]] bool has(const std::string& column) const { return place_.contains(column); }
  [[nodiscard]] std::string text(std::size_t row, const std::string& column) const {
    const std::size_t place = place_.at(column);
    return place < rows_[row].size() ? rows_[row][place] : "";
  }
  /// NaN for an empty cell.
  [[nodiscard]] double number(std::size_t row, const std::string& column) const {
    const std::string cell = text(row, column);
    return cell.empty() ? std::numeric_limits<double>::quiet_NaN() : std::stod(cell);
  }

 private:
  static std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (char c : line) {
      if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        cells.emplace_back();
      else
        cells.back() += c;
    }
    return cells;
  }
  std::map<std::string, std::size_t> place_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace polybed::test
