#include "case_mutator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace polybed::core {

namespace {

const std::vector<std::string> odd_values{"nan",
                                          "inf",
                                          "-inf",
                                          "0",
                                          "-0.0",
                                          "-1",
                                          "1e308",
                                          "-1e308",
                                          "1e-308",
                                          "1e400",
                                          "5e-324",
                                          "9223372036854775807",
                                          "-9223372036854775808",
                                          "99999999999999999999",
                                          "0x7fffffffffffffff",
                                          "\"\"",
                                          "[]",
                                          "[[]]",
                                          "{}",
                                          "true",
                                          "2026-11-21",
                                          "\"1e400 mm\"",
                                          "\"mm\"",
                                          "1_000_000",
                                          "0.1e"};

bool is_word_like(const std::string& text) {
  return !text.empty() && text != "true" && text != "false" &&
         text.find_first_not_of("0123456789.e-+[], ") != std::string::npos;
}

/// `name = value` in a table, in place of the line that says so already; in the first of an array of tables.
std::string with_entry(const std::string& text, const std::string& table, bool array, const std::string& name,
                       const std::string& value) {
  const std::string header = array ? "[[" + table + "]]" : "[" + table + "]", entry = name + " = " + value + "\n";
  const std::size_t found = table.empty() ? 0 : text.find(header);
  if (found == std::string::npos) return text + "\n" + header + "\n" + entry;
  const std::size_t begin = table.empty() ? 0 : std::min(text.find('\n', found), text.size() - 1) + 1;
  const std::size_t end = std::min(text.find("\n[", begin == 0 ? 0 : begin - 1), text.size());
  for (std::size_t at = begin; at < end; at = std::min(text.find('\n', at), text.size() - 1) + 1) {
    const std::size_t stop = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string said = text.substr(at, text.find_first_of(" =\n", at) - at);
    if (said == name) return text.substr(0, at) + entry + text.substr(stop);
  }
  return text.substr(0, begin) + entry + text.substr(begin);
}

}  // namespace

std::string CaseMutator::changed(const std::string& text) {
  if (text.empty()) return text;
  switch (below(12)) {
    case 0:
      return flipped(text);
    case 1:
      return with_tokens_swapped(text);
    case 2:
      return with_another_number(text, true);
    case 3:
      return without_a_line(text);
    case 4:
      return with_a_line_twice(text);
    case 5:
      return below(2) == 0 ? text.substr(0, below(text.size())) : with_odd_ends(text);
    case 6:
      return with_a_law(text);
    case 7:
    case 8:
    case 9:
      return with_a_key(text);
    default:
      return with_another_number(text, false);
  }
}

std::string CaseMutator::flipped(std::string text) {
  for (std::size_t n = 1 + below(4); n-- > 0;) text[below(text.size())] ^= char(1 << below(8));
  return text;
}

std::string CaseMutator::with_tokens_swapped(const std::string& text) {
  std::vector<std::pair<std::size_t, std::size_t>> tokens;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n=,[]", begin), text.size());
    if (end > begin) tokens.emplace_back(begin, end - begin);
    begin = end + 1;
  }
  if (tokens.size() < 2) return text;
  auto a = tokens[below(tokens.size())], b = tokens[below(tokens.size())];
  if (a.first > b.first) std::swap(a, b);
  if (a == b) return text;
  return text.substr(0, a.first) + text.substr(b.first, b.second) +
         text.substr(a.first + a.second, b.first - a.first - a.second) + text.substr(a.first, a.second) +
         text.substr(b.first + b.second);
}

std::string CaseMutator::with_another_number(const std::string& text, bool odd) {
  const std::size_t begin = text.find_first_of("0123456789", below(text.size()));
  if (begin == std::string::npos) return text;
  const std::size_t end = std::min(text.find_first_not_of("0123456789.e-+", begin), text.size());
  std::string other = odd_values[below(odd_values.size())];
  if (!odd) {
    // A little, or by powers of ten; a whole number stays whole.
    static const std::array<double, 8> factors{0.9, 1.1, 0.5, 2, 0.1, 10, 1e-3, 1e3};
    const std::string given = text.substr(begin, end - begin);
    char* rest = nullptr;
    const double value = std::strtod(given.c_str(), &rest) * factors[below(factors.size())];
    const bool whole = given.find_first_of(".e") == std::string::npos;
    other = whole && value >= 1 ? fmt::format("{:.0f}", value) : fmt::format("{:.6g}", value);
  }
  return text.substr(0, begin) + other + text.substr(end);
}

std::pair<std::size_t, std::size_t> CaseMutator::line(const std::string& text) {
  const std::size_t at = below(text.size()), before = text.rfind('\n', at == 0 ? 0 : at - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return {begin, std::min(text.find('\n', begin), text.size() - 1) + 1 - begin};
}

std::string CaseMutator::without_a_line(std::string text) {
  const auto [begin, size] = line(text);
  return text.erase(begin, size);
}

std::string CaseMutator::with_a_line_twice(std::string text) {
  const auto [begin, size] = line(text);
  const std::string copy = text.substr(begin, size);
  return text.insert(line(text).first, copy);
}

std::string CaseMutator::with_odd_ends(std::string text) {
  const std::size_t kind = below(3);
  if (kind > 0) return text.insert(below(text.size()), std::string(1 + below(5), kind == 1 ? '\0' : '\r'));
  std::string out;
  for (const char c : text) out += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return out;
}

/// One of the key's words, its default, an end of its range or between, or what is odd anywhere.
std::string CaseMutator::value_of(const Key& key) {
  const std::size_t kind = below(8);
  if (kind == 0) return odd_values[below(odd_values.size())];
  if (!key.words.empty()) return fmt::format("\"{}\"", key.words[below(key.words.size())]);
  if (kind < 3 && !key.standard.empty()) return is_word_like(key.standard) ? "\"" + key.standard + "\"" : key.standard;
  const double least = std::max(key.range.least, -1e9), most = std::min(key.range.most, 1e9);
  if (kind == 3) return fmt::format("{:.6g}", least);
  if (kind == 4) return fmt::format("{:.6g}", most);
  const double low = least > 0 ? least : 1e-6 * std::max(most, 1e-3), high = most > low ? most : 10 * low;
  const double between = low * std::pow(high / low, double(below(1000)) / 999);
  return kind == 5 ? fmt::format("{:.0f}", between) : fmt::format("{:.4g}", between);
}

std::string CaseMutator::with_a_key(const std::string& text) {
  const Key& key = keys()[below(keys().size())];
  return with_entry(text, std::string(key.table), find_table(key.table)->array, std::string(key.name), value_of(key));
}

std::string CaseMutator::with_a_law(const std::string& text) {
  const Role& role = roles_[below(roles_.size())];
  const std::size_t which = below(role.laws.size() + 2);
  const std::string law = which == role.laws.size()       ? "auto"
                          : which == role.laws.size() + 1 ? "none"
                                                          : role.laws[which].name;
  return with_entry(text, "effects", false, role.name, "\"" + law + "\"");
}

}  // namespace polybed::core
