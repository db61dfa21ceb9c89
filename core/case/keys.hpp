// The one table of the keys of a case file: it drives reading, checking, the schema, explanations and the docs.
#pragma once

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

/// Where a key's value lives in a scene. The index chooses the entry of an array of tables, e.g. the species.
template <class T>
using Place = T& (*)(Scene&, std::size_t index);
using AnyPlace = std::variant<Place<double>, Place<std::optional<double>>, Place<int>, Place<std::uint64_t>,
                              Place<bool>, Place<std::string>, Place<std::vector<double>>,
                              Place<std::vector<std::int64_t>>, Place<std::vector<std::string>>, Place<Points>>;

struct Key {
  std::string_view table, name;
  AnyPlace place;
  std::string_view help;
  Dimension dimension{};
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool above_least = false;               ///< the least value itself is not allowed
  std::string_view standard{};            ///< default as text; empty: none
  std::vector<std::string_view> words{};  ///< allowed texts; empty: any
  bool required = false;
  std::string_view equation{};
  bool or_number = false;  ///< a text that may also be a number, of this dimension and range
  bool by_size = false;    ///< pairs of a diameter and a value, not of a time and a value
  bool replaced = false;   ///< the resolved case has what it stands for, and not it

  [[nodiscard]] std::string path() const {
    return table.empty() ? std::string(name) : std::string(table) + "." + std::string(name);
  }
};

/// All keys, table by table. [effects] has a key for each role and is not listed.
[[nodiscard]] std::span<const Key> keys();

/// The tables that are arrays, [[species]] and [[contact_pair]].
[[nodiscard]] bool is_array_of_tables(std::string_view table);

/// Kind of a key's value for people: "length, m", "list of counts", "text" ...
[[nodiscard]] std::string kind_name(const Key& key);

/// Range for people: "above 0, at most 1"; empty if there is none.
[[nodiscard]] std::string range_text(const Key& key);

/// Whether a text is a word; a word that ends in FILE stands for any name of a file there.
[[nodiscard]] bool fits_word(std::string_view word, std::string_view text);

/// Whether a text is one of the key's words.
[[nodiscard]] bool is_word(const Key& key, std::string_view text);

/// The name nearest to a misspelt one, or empty if none is near.
[[nodiscard]] std::string nearest_name(std::string_view wrong, const std::vector<std::string>& names);

}  // namespace polybed::core
