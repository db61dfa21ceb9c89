#include "app/measure_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/print.hpp"
#include "multiscale/card/card.hpp"

namespace polybed::app {

namespace {

/// A column for people: words from its name, a unit with the prefix for its greatest number, entries.
struct ShownColumn {
  std::vector<std::string> words;
  std::string unit;
  std::vector<std::string> entries;
  std::size_t width = 0;
};

std::string in_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// Factor and unit with the prefix for the greatest number in a column.
std::pair<double, std::string> shown_unit(const MeasuredColumn& column) {
  double greatest = 0;
  for (const measures::Value& value : column.values) greatest = std::max(greatest, std::abs(value.value_or(0)));
  const bool prefixed = column.unit == "m" || column.unit == "s" || column.unit == "Pa";
  const double least = prefixed && greatest > 0 ? greatest : 1;
  const auto [scale, prefix] = least >= 1e3    ? std::pair(1e-3, "k")
                               : least >= 1    ? std::pair(1.0, "")
                               : least >= 1e-3 ? std::pair(1e3, "m")
                                               : std::pair(1e6, "µ");
  return {scale, column.unit == "1" ? "" : prefix + column.unit};
}

/// Width of a text on the screen: µ has two bytes.
std::size_t columns_on_screen(const std::string& text) {
  return text.size() - (text.find("µ") != std::string::npos ? 1 : 0);
}

ShownColumn for_people(const MeasuredColumn& column) {
  ShownColumn result;
  std::stringstream words(in_words(column.name));
  for (std::string word; words >> word;) result.words.push_back(word);
  const auto [scale, unit] = shown_unit(column);
  result.unit = unit;
  for (const measures::Value& value : column.values)
    result.entries.push_back(value ? fmt::format("{:.4g}", scale * *value) : "-");
  for (const std::string& word : result.words) result.width = std::max(result.width, word.size());
  for (const std::string& entry : result.entries) result.width = std::max(result.width, entry.size());
  result.width = std::max(result.width, columns_on_screen(result.unit));
  return result;
}

void print_block(const std::vector<const ShownColumn*>& columns) {
  std::size_t heading = 0;
  for (const ShownColumn* column : columns) heading = std::max(heading, column->words.size());
  const auto print_line = [&](auto&& entry) {
    std::string line;
    for (const ShownColumn* column : columns) line += fmt::format("{:>{}}  ", entry(*column), column->width);
    core::print("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
  };
  for (std::size_t n = 0; n < heading; ++n)
    print_line([&](const ShownColumn& column) {
      const std::size_t above = heading - column.words.size();
      return n < above ? std::string() : column.words[n - above];
    });
  print_line([](const ShownColumn& column) { return column.unit; });
  for (std::size_t row = 0; row < columns.front()->entries.size(); ++row)
    print_line([row](const ShownColumn& column) { return column.entries[row]; });
}

/// A measure over time.
struct Series {
  std::vector<double> time, value;  ///< s; NaN: no value
};

Series series_of(const MeasuredColumn& column, const measures::StoredRun& run) {
  if (const std::vector<double>* values = run.history.find(column.heading))
    return {run.history.values.front(), *values};
  Series series{run.time, {}};
  for (const measures::Value& value : column.values)
    series.value.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  return series;
}

}  // namespace

void print_table(const std::vector<MeasuredColumn>& measured) {
  constexpr std::size_t width = 100;
  std::vector<ShownColumn> columns;
  for (const MeasuredColumn& column : measured) columns.push_back(for_people(column));
  if (columns.empty()) return;
  std::vector<const ShownColumn*> block{&columns.front()};
  std::size_t used = columns.front().width;
  for (std::size_t n = 1; n < columns.size(); ++n) {
    if (block.size() > 1 && used + 2 + columns[n].width > width) {
      print_block(block);
      core::print("\n");
      block.resize(1);
      used = columns.front().width;
    }
    block.push_back(&columns[n]);
    used += 2 + columns[n].width;
  }
  print_block(block);
  core::print("definitions: polybed measure --list; --csv, --json: SI units, all digits\n");
}

void print_summary(const measures::StoredRun& run, const std::vector<MeasuredColumn>& measured) {
  const bool has_rows = !run.history.values.empty() && !run.history.values.front().empty();
  const measures::Window window = measures::last_quarter(has_rows ? run.history.values.front() : run.time);
  core::print("{:24} {:>20} {:>12}\n", "", fmt::format("mean, {:.3g} to {:.3g} s", window.begin, window.end),
              "at the end");
  for (const MeasuredColumn& column : measured) {
    const auto has_value = [](const measures::Value& value) { return value.has_value(); };
    if (std::none_of(column.values.begin(), column.values.end(), has_value)) continue;
    const auto [scale, unit] = shown_unit(column);
    const Series series = series_of(column, run);
    const auto mean = measures::time_mean(window.rows(series.time).of(series.value));
    const bool ends = !series.value.empty() && std::isfinite(series.value.back());
    core::print("{:24} {:>20} {:>12}  {}\n", in_words(column.name), mean ? mean_text(*mean, scale, "") : "-",
                ends ? fmt::format("{:.4g}", scale * series.value.back()) : "-", unit);
  }
  core::print(
      "means over the last quarter of the run, with 95 % intervals where it has rows enough\n"
      "all {} stored times: --details; definitions: --list; SI units, all digits: --csv, --json\n",
      run.time.size());
}

}  // namespace polybed::app
