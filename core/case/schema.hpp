// Declares tables of keys: each key is a member of a plain struct, and its default is the member's initialiser.
#pragma once

#include <initializer_list>
#include <optional>
#include <type_traits>
#include <utility>

#include "core/case/keys.hpp"

namespace polybed::core::schema {

/// How a member of a struct converts to a value: `kind`, `get`, `set`.
template <class T>
struct Access;

template <class T, Kind its_kind, class Stored = T>
struct Plain {
  static constexpr Kind kind = its_kind;
  static Value get(const T& place) { return static_cast<Stored>(place); }
  static void set(T& place, const Value& value) { place = static_cast<T>(std::get<Stored>(value)); }
};

template <>
struct Access<double> : Plain<double, Kind::number> {};
template <>
struct Access<int> : Plain<int, Kind::count, std::int64_t> {};
template <>
struct Access<std::uint64_t> : Plain<std::uint64_t, Kind::count, std::int64_t> {};
template <>
struct Access<bool> : Plain<bool, Kind::truth> {};
template <>
struct Access<std::string> : Plain<std::string, Kind::text> {};
template <>
struct Access<std::vector<double>> : Plain<std::vector<double>, Kind::numbers> {};
template <>
struct Access<std::vector<std::int64_t>> : Plain<std::vector<std::int64_t>, Kind::counts> {};
template <>
struct Access<std::vector<std::string>> : Plain<std::vector<std::string>, Kind::texts> {};
template <>
struct Access<Points> : Plain<Points, Kind::points> {};

template <class Choice>
requires std::is_enum_v<Choice>
struct Access<Choice> {
  static constexpr Kind kind = Kind::text;
  static constexpr auto words = names(Choice{});
  static Value get(Choice place) { return std::string(name_of(place)); }
  static void set(Choice& place, const Value& value) { place = choice_of<Choice>(std::get<std::string>(value)); }
};

template <>
struct Access<Start> {
  static constexpr Kind kind = Kind::text;
  static constexpr auto words = names(StartKind{});
  static Value get(const Start& place) { return text_of(place); }
  static void set(Start& place, const Value& value);
};

template <class Choice>
struct Access<std::variant<Choice, double>> : Access<Choice> {
  static constexpr Kind kind = Kind::word_or_number;
  static Value get(const std::variant<Choice, double>& place) {
    const double* number = std::get_if<double>(&place);
    return number != nullptr ? Value(*number) : Access<Choice>::get(std::get<Choice>(place));
  }
  static void set(std::variant<Choice, double>& place, const Value& value) {
    const double* number = std::get_if<double>(&value);
    number != nullptr ? void(place = *number) : Access<Choice>::set(place.template emplace<Choice>(), value);
  }
};

template <class T>
struct Access<std::optional<T>> : Access<T> {
  static Value get(const std::optional<T>& place) { return place ? Access<T>::get(*place) : Value{}; }
  static void set(std::optional<T>& place, const Value& value) { Access<T>::set(place.emplace(), value); }
};

// Properties of a key besides its dimension and Range.
struct Help {
  std::string_view text;
};
struct Equation {
  std::string_view text;
};
struct Words {
  std::vector<std::string_view> words;
};
enum class Mark {
  required,
  given,     ///< required unless another key is given: its initialiser is no default
  replaced,  ///< not in the resolved case
  by_size,   ///< pairs of a diameter and a value, instead of a time and a value
  by_height  ///< pairs of a height and a value
};

inline Help help(std::string_view text) { return {text}; }
inline Equation equation(std::string_view text) { return {text}; }
inline Range range(double least, double most) { return {least, most, false}; }
/// Greater than `least`.
inline Range above(double least, double most) { return {least, most, true}; }
template <class... Word>
Words choices(Word... words) {
  return {{words...}};
}

/// A key of a struct, not yet bound to a place in a scene.
template <class S>
struct KeyOf {
  Key key;
  bool no_default = false;
  std::function<Value(const S&)> get;
  std::function<void(S&, const Value&)> set;
  std::function<Value(const Scene&)> get_elsewhere{};  ///< for a key whose value is stored in another struct
  std::function<void(Scene&, const Value&)> set_elsewhere{};

  void say(const Help& fact) { key.help = fact.text; }
  void say(const Equation& fact) { key.equation = fact.text; }
  void say(const Dimension& fact) { key.dimension = fact; }
  void say(const Range& fact) { key.range = fact; }
  void say(const Words& fact) { key.words = fact.words; }
  void say(Mark fact) {
    key.required |= fact == Mark::required;
    key.replaced |= fact == Mark::replaced;
    no_default |= fact == Mark::required || fact == Mark::given;
    if (fact == Mark::by_size) key.kind = Kind::sieves;
    if (fact == Mark::by_height) key.kind = Kind::heights;
  }
};

template <class S, class T, class... Facts>
KeyOf<S> key(T S::*member, std::string_view name, const Facts&... facts) {
  KeyOf<S> made{{.table = {}, .name = name, .kind = Access<T>::kind, .help = {}}, false, {}, {}};
  made.get = [member](const S& from) { return Access<T>::get(from.*member); };
  made.set = [member](S& into, const Value& value) { Access<T>::set(into.*member, value); };
  if constexpr (requires { Access<T>::words; }) made.key.words = {Access<T>::words.begin(), Access<T>::words.end()};
  (made.say(facts), ...);
  return made;
}

/// A key in a part of a struct, as a key of the whole.
template <class S, class Part>
KeyOf<S> within(Part S::*part, const KeyOf<Part>& inner) {
  return {inner.key, inner.no_default, [part, inner](const S& from) { return inner.get(from.*part); },
          [part, inner](S& into, const Value& value) { inner.set(into.*part, value); }};
}

/// A key in the table of S whose value both models read: it is stored in another part of the scene.
template <class S, class Part>
KeyOf<S> shared(Part Scene::*part, const KeyOf<Part>& inner) {
  KeyOf<S> made{inner.key, inner.no_default, {}, {}};
  made.get_elsewhere = [part, inner](const Scene& from) { return inner.get(from.*part); };
  made.set_elsewhere = [part, inner](Scene& into, const Value& value) { inner.set(into.*part, value); };
  return made;
}

/// A value as text that a case could give, with the unit of its key; empty if there is nothing.
[[nodiscard]] std::string text_of(const Value& value, const Dimension& dimension);

/// \param at  (scene, index) -> the struct, for a scene that can be constant
template <class S, class At>
Table table_of(std::string_view name, bool array, const At& at, std::initializer_list<KeyOf<S>> keys) {
  Table made{name, array, {}, [](const Scene&) { return std::size_t(1); }, {}};
  const S untouched{};
  for (const KeyOf<S>& given : keys) {
    Key key = given.key;
    key.table = name;
    if (given.get_elsewhere) {
      key.get = [get = given.get_elsewhere](const Scene& scene, std::size_t) { return get(scene); };
      key.set = [set = given.set_elsewhere](Scene& scene, std::size_t, const Value& value) { set(scene, value); };
    } else {
      key.get = [at, get = given.get](const Scene& scene, std::size_t n) { return get(at(scene, n)); };
      key.set = [at, set = given.set](Scene& scene, std::size_t n, const Value& value) { set(at(scene, n), value); };
    }
    if (!given.no_default)
      key.standard = text_of(given.get_elsewhere ? given.get_elsewhere(Scene()) : given.get(untouched), key.dimension);
    made.keys.push_back(std::move(key));
  }
  return made;
}

/// A table [name] that occurs once in a scene.
template <class S>
Table table(std::string_view name, S Scene::*place, std::initializer_list<KeyOf<S>> keys) {
  return table_of<S>(
      name, false, [place](auto& scene, std::size_t) -> auto& { return scene.*place; }, keys);
}

/// An array of tables [[name]].
template <class S>
Table table(std::string_view name, std::vector<S> Scene::*place, std::initializer_list<KeyOf<S>> keys) {
  Table made = table_of<S>(
      name, true, [place](auto& scene, std::size_t n) -> auto& { return (scene.*place)[n]; }, keys);
  made.count = [place](const Scene& scene) { return (scene.*place).size(); };
  made.resize = [place](Scene& scene, std::size_t count) { (scene.*place).resize(count); };
  return made;
}

// The tables, by subject.
[[nodiscard]] std::vector<Table> bed_tables();    ///< title, column, fluid, species, bed, layer, inlet
[[nodiscard]] std::vector<Table> run_tables();    ///< chooser, run, output
[[nodiscard]] std::vector<Table> model_tables();  ///< tfm, dem, calibrate, resolve
[[nodiscard]] std::vector<Table> part_tables();   ///< jet, feed, discharge, wall, contact_pair

}  // namespace polybed::core::schema
