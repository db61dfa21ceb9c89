#include "core/case/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/case/removed.hpp"

namespace polybed::core {

namespace {

/// The value as in a case file, numbers with their fewest digits: 0.95, not 0.94999999999999996.
std::string as_typed(const toml::node& node) {
  if (const auto* number = node.as_floating_point()) {
    const std::string text = fmt::format("{}", number->get());
    return text.find_first_not_of("-0123456789") == std::string::npos ? text + ".0" : text;
  }
  if (const toml::array* array = node.as_array()) {
    std::vector<std::string> entries;
    for (const toml::node& entry : *array) entries.push_back(as_typed(entry));
    return fmt::format("[ {} ]", fmt::join(entries, ", "));
  }
  std::ostringstream out;
  node.visit([&](const auto& value) { out << value; });
  return out.str();
}

}  // namespace

std::string shown(const toml::node& node) {
  std::string text = as_typed(node);
  std::replace(text.begin(), text.end(), '\n', ' ');
  constexpr std::size_t longest = 60;
  return text.size() > longest ? text.substr(0, longest) + "..." : text;
}

namespace {

/// A list; `read` reads each entry.
template <class Read>
auto list(CaseValues& values, const Key& key, const toml::node& node, const Read& read)
    -> std::optional<std::vector<typename decltype(read(node))::value_type>> {
  const toml::array* array = node.as_array();
  if (array == nullptr) {
    values.add(node.source(), fmt::format("{} = {}: expected a list in [ ]", key.path(), shown(node)));
    return std::nullopt;
  }
  std::vector<typename decltype(read(node))::value_type> entries;
  for (const toml::node& entry : *array) {
    const auto value = read(entry);
    if (!value) return std::nullopt;
    entries.push_back(*value);
  }
  return entries;
}

/// Whether a value of a key for a word or a number is a number, with a unit if the key has one.
bool is_quantity(const Key& key, const toml::node& node) {
  const auto text = node.value<std::string_view>();
  return node.is_number() || (text && !(key.dimension == dimension::none) && parse_quantity(*text));
}

template <class T>
Value value_or_none(std::optional<T> read) {
  return read ? Value(std::move(*read)) : Value{};
}

}  // namespace

Value CaseValues::read(const Key& key, const toml::node& node) {
  switch (key.kind) {
    case Kind::number:
      return value_or_none(number(key, node));
    case Kind::count:
      return value_or_none(count(key, node));
    case Kind::truth:
      return value_or_none(truth(key, node));
    case Kind::text:
      return value_or_none(text(key, node));
    case Kind::word_or_number:
      return is_quantity(key, node) ? value_or_none(number(key, node)) : value_or_none(text(key, node));
    case Kind::numbers:
      return value_or_none(list(*this, key, node, [&](const toml::node& n) { return number(key, n); }));
    case Kind::counts:
      return value_or_none(list(*this, key, node, [&](const toml::node& n) { return count(key, n); }));
    case Kind::texts:
      return value_or_none(list(*this, key, node, [&](const toml::node& n) { return text(key, n); }));
    case Kind::points:
      return value_or_none(points(key, node));
    case Kind::sieves:
      return value_or_none(sieves(key, node));
    case Kind::heights:
      return value_or_none(points(key, node));
  }
  return {};
}

Place CaseValues::place_of(const toml::source_region& region) const {
  if (region.path && *region.path != file_) return {*region.path, 0, 0};
  return {file_, int(region.begin.line), int(region.begin.column)};
}

void CaseValues::add(const toml::source_region& place, std::string message) {
  const Place at = place_of(place);
  problems_.push_back({at.file, at.line, at.column, std::move(message)});
}

void CaseValues::expected(const Key& key, const toml::node& node, std::string_view what) {
  add(node.source(), fmt::format("{} = {}: expected {}", key.path(), shown(node), what));
}

std::optional<double> CaseValues::number(const Key& key, const toml::node& node) {
  Quantity q;
  if (node.is_number()) {
    q.value = *node.value<double>();
  } else if (const auto text = node.value<std::string_view>()) {
    const auto parsed = parse_quantity(*text);
    if (!parsed) {
      std::string with_point(*text);
      std::replace(with_point.begin(), with_point.end(), ',', '.');
      const bool comma = parse_quantity(with_point).has_value();
      expected(key, node,
               fmt::format("a number with a unit such as \"1 {}\"; {}", unit_name(key.dimension),
                           comma ? "did you mean \"" + with_point + "\"?" : "polybed schema lists the units"));
      return std::nullopt;
    }
    q = *parsed;
    if (q.has_unit && !(q.dimension == key.dimension)) {
      expected(key, node,
               fmt::format("a value in {}, this one is in {}", unit_name(key.dimension), unit_name(q.dimension)));
      return std::nullopt;
    }
  } else {
    expected(key, node, "a number, or a text with a unit");
    return std::nullopt;
  }
  constexpr double least_meant = 1e-100;
  if (q.value != 0 && std::abs(q.value) < least_meant) {
    add(node.source(), fmt::format("{} = {} is too small to be meant: give 0, or at least {:g}", key.path(),
                                   shown(node), least_meant));
    return std::nullopt;
  }
  const auto& [least, most, above_least] = key.range;
  const bool low = above_least ? !(q.value > least) : !(q.value >= least);
  if (!std::isfinite(q.value) || low || q.value > most) {
    std::string hint;
    if (key.dimension == dimension::length && !q.has_unit && q.value * 1e-3 <= most && q.value > most)
      hint = fmt::format("; did you mean \"{:g} mm\"?", q.value);
    add(node.source(), fmt::format("{} = {} is out of range: {}{}", key.path(), shown(node), range_text(key), hint));
    return std::nullopt;
  }
  if (key.table == "species" && key.dimension == dimension::length && !q.has_unit && q.value > 0.05) {
    add(node.source(), fmt::format("{} = {:g} m is larger than any particle here: did you mean \"{:g} mm\"?",
                                   key.path(), q.value, q.value));
    return std::nullopt;
  }
  return q.value;
}

std::optional<std::int64_t> CaseValues::count(const Key& key, const toml::node& node) {
  const auto value = node.value_exact<std::int64_t>();
  if (!value) {
    expected(key, node, "a whole number");
    return std::nullopt;
  }
  if (double(*value) < key.range.least || double(*value) > key.range.most) {
    add(node.source(), fmt::format("{} = {} is out of range: {}", key.path(), *value, range_text(key)));
    return std::nullopt;
  }
  return value;
}

std::optional<bool> CaseValues::truth(const Key& key, const toml::node& node) {
  const auto value = node.value_exact<bool>();
  if (!value) expected(key, node, "true or false");
  return value;
}

std::optional<std::string> CaseValues::text(const Key& key, const toml::node& node) {
  const auto value = node.value_exact<std::string>();
  if (!value) {
    expected(key, node, key.kind == Kind::word_or_number ? "a number, or a text in quotes" : "a text in quotes");
    return std::nullopt;
  }
  if (!key.words.empty() && !is_word(key, *value)) {
    const std::string near = nearest_name(*value, {key.words.begin(), key.words.end()});
    std::string hint = instead_of_removed(key.path(), *value);
    if (hint.empty() && !near.empty()) hint = "; did you mean \"" + near + "\"?";
    add(node.source(), fmt::format("{} = \"{}\": allowed are {}{}", key.path(), *value, range_text(key), hint));
    return std::nullopt;
  }
  return value;
}

namespace {

/// The meaning of the first number in a pair.
struct First {
  const char *pair, *order;
  Dimension dimension;
  Range range;
};

First first_of(Kind kind) {
  if (kind == Kind::sieves) return {"[opening, share]", "openings must rise", dimension::length, {1e-8, 1}};
  if (kind == Kind::heights) return {"[height, diameter]", "heights must not fall", dimension::length, {0, 1e3}};
  return {"[time, velocity]", "times must not fall", dimension::time, {0, 1e9}};
}

}  // namespace

std::optional<Points> CaseValues::points(const Key& key, const toml::node& node) {
  const toml::array* rows = node.as_array();
  const bool by_size = key.kind == Kind::sieves;
  const First of_pair = first_of(key.kind);
  if (rows == nullptr && key.kind != Kind::points) {
    expected(key, node, fmt::format("a table of pairs {}", of_pair.pair));
    return std::nullopt;
  }
  if (rows == nullptr) {
    const auto value = number(key, node);
    return value ? std::optional(Points{{0.0, *value}}) : std::nullopt;
  }
  Key first = key;
  first.dimension = of_pair.dimension;
  first.range = of_pair.range;
  const std::string pair_name = fmt::format("a pair {}", of_pair.pair);
  Points table;
  for (const toml::node& row : *rows) {
    const toml::array* pair = row.as_array();
    if (pair == nullptr || pair->size() != 2) {
      expected(key, row, pair_name);
      return std::nullopt;
    }
    const auto t = number(first, *pair->get(0)), v = number(key, *pair->get(1));
    if (!t || !v) return std::nullopt;
    const bool falls = !table.empty() && *t < table.back().first;
    if (falls || (by_size && !table.empty() && *t == table.back().first)) {
      add(row.source(), fmt::format("{}: {}", key.path(), of_pair.order));
      return std::nullopt;
    }
    table.emplace_back(*t, *v);
  }
  if (table.empty()) expected(key, node, "at least one: " + pair_name);
  return table;
}

std::optional<Points> CaseValues::sieves(const Key& key, const toml::node& node) {
  const auto table = points(key, node);
  if (!table) return std::nullopt;
  double sum = 0;
  for (const auto& [opening, share] : *table) sum += share;
  if (table->size() < 2 || table->back().second != 0)
    add(node.source(),
        fmt::format("{}: at least two sieves, the last with a share of 0: what everything passes", key.path()));
  else if (!(std::abs(sum - 1) <= 1e-9))
    add(node.source(), fmt::format("{}: the shares sum to {:.9g}, not to 1", key.path(), sum));
  return table;
}

}  // namespace polybed::core
