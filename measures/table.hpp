// A table of measures: each row has a name, a unit, a definition and a function. The table defines the columns of
// history.csv, the heights whose drift a run reports, the answers of polybed measure, the page in the documentation and
// the table in the Python package.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/numerics/field.hpp"

namespace polybed::measures {

using Value = std::optional<double>;  ///< empty: there is nothing to measure

/// Indices of the species that count as one: a single one, or all size classes of one.
using Members = std::span<const std::size_t>;

[[nodiscard]] inline double sum_of(const std::vector<double>& values, Members members) {
  double sum = 0;
  for (const std::size_t j : members) sum += values[j];
  return sum;
}

/// A species as the case names it.
struct Kind {
  std::string name;
  std::vector<std::size_t> members;
  bool is_class = false;  ///< a size class of a species, which is a kind, too
};

/// Each species, then each species with size classes ("sand.1", "sand.2") as a whole ("sand"). No classes belong to
/// "sand" if a case names a species so itself.
[[nodiscard]] std::vector<Kind> kinds_of(const std::vector<std::string>& species);

/// The species as the case names them, in its order: size classes count as one.
[[nodiscard]] std::vector<Kind> named_species(const std::vector<std::string>& species);

/// Those with size classes, and the sum of the classes' fractions in cells.
[[nodiscard]] std::vector<Kind> divided_species(const std::vector<std::string>& species);
[[nodiscard]] core::Field sum_of(const std::vector<core::Field>& fractions, Members members);

/// The readers of a measure.
struct Readers {
  bool history = true;   ///< history.csv has a column for it
  bool profile = false;  ///< computed from a profile alone, and reported by polybed measure
  bool drift = false;    ///< a height, m: a run reports at its end whether it still drifts
  bool picture = false;  ///< a level in the bed, m: pictures of the history and of profiles show it as a line
};

/// One row: a measure of a `Source`, as a whole, of each species in it, or between the species that the case names.
template <class Source>
struct Measure {
  using OfWhole = std::function<Value(const Source&)>;
  using OfSpecies = std::function<Value(const Source&, Members)>;
  using OfNamed = std::function<Value(const Source&, const std::vector<Kind>&)>;

  std::string name;  ///< "bed_height"; "centre" of the species "fine" is "centre_fine"
  std::string unit;  ///< "1" for a number
  std::string help;  ///< its definition
  std::variant<OfWhole, OfSpecies, OfNamed> of;
  Readers readers = {};

  [[nodiscard]] bool of_species() const { return std::holds_alternative<OfSpecies>(of); }
  /// For a row that is not of each species.
  [[nodiscard]] OfWhole of_whole(const std::vector<std::string>& species) const {
    if (const auto* whole = std::get_if<OfWhole>(&of)) return *whole;
    return [between = std::get<OfNamed>(of), kinds = named_species(species)](const Source& s) {
      return between(s, kinds);
    };
  }
};

template <class Source>
using Table = std::vector<Measure<Source>>;

/// The rows with a given reader, e.g. &Readers::history.
template <class Source>
[[nodiscard]] Table<Source> read_by(bool Readers::*reader, Table<Source> table) {
  std::erase_if(table, [reader](const Measure<Source>& measure) { return !(measure.readers.*reader); });
  return table;
}

/// A measure with one number.
template <class Source>
struct Single {
  std::string name, unit, help;
  typename Measure<Source>::OfWhole of;
  Readers readers = {};

  /// "bed_height_m", "mixing"
  static constexpr const char* of_number = "1";
  [[nodiscard]] std::string column() const { return unit == of_number ? name : name + "_" + unit; }
};

/// The numbers in a table for given species: for each species, and for each species with size classes as a whole.
/// Adjacent rows per species stay together, species by species.
template <class Source>
[[nodiscard]] std::vector<Single<Source>> singles(const Table<Source>& table, const std::vector<std::string>& species) {
  using Row = Measure<Source>;
  std::vector<Single<Source>> found;
  for (auto row = table.begin(); row != table.end();) {
    if (!row->of_species()) {
      found.push_back({row->name, row->unit, row->help, row->of_whole(species), row->readers});
      ++row;
      continue;
    }
    const auto end = std::find_if(row, table.end(), [](const Row& later) { return !later.of_species(); });
    for (const Kind& kind : kinds_of(species))
      for (auto one = row; one != end; ++one)
        found.push_back({one->name + "_" + kind.name, one->unit, one->help,
                         [of = std::get<typename Row::OfSpecies>(one->of), members = kind.members](const Source& s) {
                           return of(s, members);
                         },
                         one->readers});
    row = end;
  }
  return found;
}

/// The values of the measures, in order.
template <class Source>
[[nodiscard]] std::vector<Value> values(const std::vector<Single<Source>>& measures, const Source& source) {
  std::vector<Value> found;
  for (const Single<Source>& measure : measures) found.push_back(measure.of(source));
  return found;
}

}  // namespace polybed::measures
