// The one table of the keys of a case file: it drives reading, checking, the schema, explanations and the docs.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/case/scene.hpp"
#include "core/case/units.hpp"

namespace polybed::core {

using Points = std::vector<std::pair<double, double>>;

/// A key's value; nothing if it is not set. A choice is stored as its word.
using Value = std::variant<std::monostate, double, std::int64_t, bool, std::string, std::vector<double>,
                           std::vector<std::int64_t>, std::vector<std::string>, Points>;

enum class Kind { number, count, truth, text, word_or_number, numbers, counts, texts, points, sieves, heights };

struct Range {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool above_least = false;  ///< the least value itself is not allowed
};

struct Key {
  std::string_view table, name;
  Kind kind{};
  std::string_view help, equation{};
  Dimension dimension{};
  Range range{};
  std::vector<std::string_view> words{};  ///< allowed texts; empty: any
  bool required = false;
  bool replaced = false;   ///< the resolved case contains its replacement instead
  std::string standard{};  ///< default as text that a case could give; empty: there is no default
  std::function<Value(const Scene&, std::size_t index)>
      get{};  ///< index: entry of an array of tables, e.g. the species
  std::function<void(Scene&, std::size_t index, const Value&)> set{};

  [[nodiscard]] std::string path() const {
    return table.empty() ? std::string(name) : std::string(table) + "." + std::string(name);
  }
};

struct Table {
  std::string_view name;
  bool array = false;  ///< as [[species]]
  std::vector<Key> keys;
  std::function<std::size_t(const Scene&)> count;           ///< entries in a scene; 1 without an array
  std::function<void(Scene&, std::size_t count)> resize{};  ///< sets the number of entries of an array
};

/// All tables and their keys. [effects] has a key for each role and is not listed.
[[nodiscard]] std::span<const Table> tables();

/// The keys of all tables, table by table.
[[nodiscard]] std::span<const Key> keys();

/// A table by its name, null if there is none.
[[nodiscard]] const Table* find_table(std::string_view name);

/// A table as a case file heads it: "[column]", "[[species]]".
[[nodiscard]] std::string header(const Table& table);

/// Description of a key's value for people: "length, m", "list of counts", "text" ...
[[nodiscard]] std::string kind_name(const Key& key);

/// Range for people: "above 0, at most 1"; empty if there is none.
[[nodiscard]] std::string range_text(const Key& key);

/// Whether a text matches a word. In a word that ends in FILE, any file name matches FILE.
[[nodiscard]] bool fits_word(std::string_view word, std::string_view text);

/// Whether a text is one of the key's words.
[[nodiscard]] bool is_word(const Key& key, std::string_view text);

/// The name nearest to a misspelt one, or empty if none is near.
[[nodiscard]] std::string nearest_name(std::string_view wrong, const std::vector<std::string>& names);

}  // namespace polybed::core
