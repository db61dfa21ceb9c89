#include "core/case/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "core/case/schema.hpp"

namespace polybed::core {

namespace {

std::vector<Table> all_tables() {
  std::vector<Table> all;
  for (auto* part : {schema::bed_tables, schema::run_tables, schema::model_tables, schema::part_tables})
    for (Table& table : part()) all.push_back(std::move(table));
  return all;
}

/// The fewest digits that identify a number: "9.81", "101325", "3e8", "1e-4".
std::string short_number(double value) {
  if (value == 0 || (std::abs(value) >= 1e-3 && std::abs(value) < 1e6)) return fmt::format("{}", value);
  std::string text;
  for (int digits = 0; text.empty() || std::strtod(text.c_str(), nullptr) != value; ++digits)
    text = fmt::format("{:.{}e}", value, digits);
  const std::size_t exponent = text.find('e');
  return fmt::format("{}e{}", text.substr(0, exponent), std::atoi(text.c_str() + exponent + 1));
}

/// Number of edits that turn one text into the other: insert, delete, replace, swap of neighbours.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t(0));
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before = last;
    last = now;
  }
  return last[b.size()];
}

}  // namespace

std::span<const Table> tables() {
  static const std::vector<Table> all = all_tables();
  return all;
}

std::span<const Key> keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> list;
    for (const Table& table : tables()) list.insert(list.end(), table.keys.begin(), table.keys.end());
    return list;
  }();
  return all;
}

const Table* find_table(std::string_view name) {
  const auto found = std::find_if(tables().begin(), tables().end(), [&](const Table& t) { return t.name == name; });
  return found == tables().end() ? nullptr : &*found;
}

std::string schema::text_of(const Value& value, const Dimension& dimension) {
  if (const double* number = std::get_if<double>(&value))
    return short_number(*number) + (dimension == dimension::none ? "" : " " + unit_name(dimension));
  if (const auto* count = std::get_if<std::int64_t>(&value)) return std::to_string(*count);
  if (const bool* truth = std::get_if<bool>(&value)) return *truth ? "true" : "false";
  const auto* text = std::get_if<std::string>(&value);
  return text == nullptr ? "" : *text;
}

std::string header(const Table& table) {
  return table.array ? fmt::format("[[{}]]", table.name) : fmt::format("[{}]", table.name);
}

std::string kind_name(const Key& key) {
  constexpr std::array names{"number",
                             "count",
                             "true or false",
                             "text",
                             "text",
                             "list of numbers",
                             "list of counts",
                             "list of texts",
                             "number or table in time",
                             "table of length, m, and number",
                             "table of height, m, and length"};
  const std::string kind = names[std::size_t(key.kind)];
  return key.dimension == dimension::none ? kind : kind + ", " + unit_name(key.dimension);
}

bool fits_word(std::string_view word, std::string_view text) {
  constexpr std::string_view file = "FILE";
  if (!word.ends_with(file)) return word == text;
  word.remove_suffix(file.size());
  return text.starts_with(word) && text.size() > word.size();
}

bool is_word(const Key& key, std::string_view text) {
  return std::any_of(key.words.begin(), key.words.end(), [&](std::string_view word) { return fits_word(word, text); });
}

std::string range_text(const Key& key) {
  const bool or_number = key.kind == Kind::word_or_number;
  if (!key.words.empty() && !or_number) return fmt::format("{}", fmt::join(key.words, " | "));
  const auto& [least, most, above_least] = key.range;
  std::string text;
  if (std::isfinite(least)) text = fmt::format("{} {:g}", above_least ? "above" : "at least", least);
  if (std::isfinite(most)) text += fmt::format("{}at most {:g}", text.empty() ? "" : ", ", most);
  if (!text.empty() && !(key.dimension == dimension::none)) text += " " + unit_name(key.dimension);
  return or_number ? fmt::format("{} | a number {}", fmt::join(key.words, " | "), text) : text;
}

std::string nearest_name(std::string_view wrong, const std::vector<std::string>& names) {
  std::string best;
  std::size_t fewest = std::max<std::size_t>(2, wrong.size() / 3) + 1;
  for (const std::string& name : names)
    if (const std::size_t n = edits(wrong, name); n < fewest) {
      fewest = n;
      best = name;
    }
  return best;
}

}  // namespace polybed::core
