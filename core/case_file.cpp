#include "core/case_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>

#include "core/keys.hpp"

namespace polybed::core {

namespace {

/// One reading of a case: the scene as it grows, and the problems found so far.
class CaseReader {
 public:
  CaseReader(std::string name, std::span<const Role> roles) : name_(std::move(name)), roles_(roles) {}

  void read(toml::table& root, std::span<const std::string> overrides);
  Scene finish();
  void add(const toml::node* node, std::string message);

 private:
  void apply_override(toml::table& root, const std::string& text);
  void read_table(const toml::table& table, std::string_view name, std::size_t index);
  void read_entry(std::string_view table, const toml::key& name, const toml::node& node);
  void read_effects(const toml::node& node);
  void read_key(const Key& key, std::size_t index, const toml::node& node);
  void check_missing(const toml::table& table, std::string_view name, std::size_t index, const toml::node& where);
  void wrong_key(const toml::key& key, std::string_view table);

  std::optional<double> number(const Key& key, const toml::node& node);
  std::optional<std::int64_t> count(const Key& key, const toml::node& node);
  std::optional<std::string> text(const Key& key, const toml::node& node);
  std::optional<Points> points(const Key& key, const toml::node& node);
  template <class T, class Read>
  std::optional<std::vector<T>> list(const Key& key, const toml::node& node, Read&& read);
  void expected(const Key& key, const toml::node& node, std::string_view what);

  std::string name_;
  std::span<const Role> roles_;
  Scene scene_;
  std::vector<CaseProblem> problems_;
  std::vector<std::string> given_;  ///< paths of the keys that the case sets
};

/// A name as people write it: [table] or [[array]].
std::string bracketed(std::string_view table) {
  return is_array_of_tables(table) ? fmt::format("[[{}]]", table) : fmt::format("[{}]", table);
}

std::string shown(const toml::node& node) {
  std::ostringstream out;
  node.visit([&](const auto& value) { out << value; });
  std::string text = out.str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  constexpr std::size_t longest = 60;
  return text.size() > longest ? text.substr(0, longest) + "..." : text;
}

void CaseReader::add(const toml::node* node, std::string message) {
  CaseProblem problem{name_, 0, 0, std::move(message)};
  if (node != nullptr && node->source().begin.line > 0) {
    if (node->source().path) problem.file = *node->source().path;
    problem.line = int(node->source().begin.line);
    problem.column = int(node->source().begin.column);
  }
  problems_.push_back(std::move(problem));
}

void CaseReader::expected(const Key& key, const toml::node& node, std::string_view what) {
  add(&node, fmt::format("{} = {}: expected {}", key.path(), shown(node), what));
}

std::optional<double> CaseReader::number(const Key& key, const toml::node& node) {
  Quantity q;
  if (node.is_number()) {
    q.value = *node.value<double>();
  } else if (const auto text = node.value<std::string_view>()) {
    const auto parsed = parse_quantity(*text);
    if (!parsed) {
      expected(key, node, fmt::format("a number with a unit such as \"1 {}\"", unit_name(key.dimension)));
      return std::nullopt;
    }
    q = *parsed;
    if (q.has_unit && !(q.dimension == key.dimension)) {
      expected(key, node, fmt::format("a value in {}, this one is in {}", unit_name(key.dimension), unit_name(q.dimension)));
      return std::nullopt;
    }
  } else {
    expected(key, node, "a number, or a text with a unit");
    return std::nullopt;
  }
  const bool low = key.above_least ? !(q.value > key.least) : !(q.value >= key.least);
  if (!std::isfinite(q.value) || low || q.value > key.most) {
    std::string hint;
    if (key.dimension == dimension::length && !q.has_unit && q.value * 1e-3 <= key.most && q.value > key.most)
      hint = fmt::format("; did you mean \"{:g} mm\"?", q.value);
    add(&node, fmt::format("{} = {} is out of range: {}{}", key.path(), shown(node), range_text(key), hint));
    return std::nullopt;
  }
  if (key.table == "species" && key.name == "diameter" && !q.has_unit && q.value > 0.05) {
    add(&node, fmt::format("{} = {:g} m is larger than any particle here: did you mean \"{:g} mm\"?", key.path(), q.value, q.value));
    return std::nullopt;
  }
  return q.value;
}

std::optional<std::int64_t> CaseReader::count(const Key& key, const toml::node& node) {
  const auto value = node.value_exact<std::int64_t>();
  if (!value) {
    expected(key, node, "a whole number");
    return std::nullopt;
  }
  if (double(*value) < key.least || double(*value) > key.most) {
    add(&node, fmt::format("{} = {} is out of range: {}", key.path(), *value, range_text(key)));
    return std::nullopt;
  }
  return value;
}

std::optional<std::string> CaseReader::text(const Key& key, const toml::node& node) {
  const bool number_allowed = key.name == "max_packing";
  if (number_allowed && node.is_number()) return fmt::format("{}", *node.value<double>());
  const auto value = node.value_exact<std::string>();
  if (!value) {
    expected(key, node, "a text in quotes");
    return std::nullopt;
  }
  if (!key.words.empty() && std::find(key.words.begin(), key.words.end(), *value) == key.words.end()) {
    const std::string near = nearest_name(*value, {key.words.begin(), key.words.end()});
    add(&node, fmt::format("{} = \"{}\": allowed are {}{}", key.path(), *value, range_text(key),
                           near.empty() ? "" : "; did you mean \"" + near + "\"?"));
    return std::nullopt;
  }
  if (number_allowed && *value != "auto") {
    add(&node, fmt::format("{} = \"{}\": allowed are \"auto\" or a number below 1", key.path(), *value));
    return std::nullopt;
  }
  return value;
}

template <class T, class Read>
std::optional<std::vector<T>> CaseReader::list(const Key& key, const toml::node& node, Read&& read) {
  const toml::array* array = node.as_array();
  if (array == nullptr) {
    expected(key, node, "a list in [ ]");
    return std::nullopt;
  }
  std::vector<T> values;
  for (const toml::node& entry : *array) {
    const auto value = read(entry);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::optional<Points> CaseReader::points(const Key& key, const toml::node& node) {
  const toml::array* rows = node.as_array();
  if (rows == nullptr) {
    const auto value = number(key, node);
    return value ? std::optional(Points{{0.0, *value}}) : std::nullopt;
  }
  static const Key time{"inlet", "superficial_velocity", key.place, "", dimension::time, 0, 1e9};
  Points table;
  for (const toml::node& row : *rows) {
    const toml::array* pair = row.as_array();
    if (pair == nullptr || pair->size() != 2) {
      expected(key, row, "a pair [time, velocity]");
      return std::nullopt;
    }
    const auto t = number(time, *pair->get(0)), v = number(key, *pair->get(1));
    if (!t || !v) return std::nullopt;
    if (!table.empty() && *t < table.back().first) {
      add(&row, fmt::format("{}: times must not fall", key.path()));
      return std::nullopt;
    }
    table.emplace_back(*t, *v);
  }
  if (table.empty()) expected(key, node, "at least one pair [time, velocity]");
  return table;
}

void CaseReader::read_key(const Key& key, std::size_t index, const toml::node& node) {
  given_.push_back(key.path());
  const auto store = [&](auto place, const auto& value) {
    if (value) place(scene_, index) = *value;
  };
  std::visit(
      [&](auto place) {
        using T = std::remove_reference_t<decltype(place(scene_, index))>;
        if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>>)
          store(place, number(key, node));
        else if constexpr (std::is_same_v<T, int> || std::is_same_v<T, std::uint64_t>) {
          if (const auto value = count(key, node)) place(scene_, index) = T(*value);
        } else if constexpr (std::is_same_v<T, bool>) {
          if (const auto value = node.value_exact<bool>()) place(scene_, index) = *value;
          else expected(key, node, "true or false");
        } else if constexpr (std::is_same_v<T, std::string>)
          store(place, text(key, node));
        else if constexpr (std::is_same_v<T, std::vector<double>>)
          store(place, list<double>(key, node, [&](const toml::node& n) { return number(key, n); }));
        else if constexpr (std::is_same_v<T, std::vector<std::int64_t>>)
          store(place, list<std::int64_t>(key, node, [&](const toml::node& n) { return count(key, n); }));
        else if constexpr (std::is_same_v<T, std::vector<std::string>>)
          store(place, list<std::string>(key, node, [&](const toml::node& n) { return text(key, n); }));
        else
          store(place, points(key, node));
      },
      key.place);
}

void CaseReader::wrong_key(const toml::key& key, std::string_view table) {
  std::vector<std::string> names;
  for (const Key& k : keys())
    if (k.table == table) names.emplace_back(k.name);
  if (table == "effects")
    for (const Role& role : roles_) names.push_back(role.name);
  if (table.empty())
    for (const Key& k : keys()) names.emplace_back(k.table.empty() ? k.name : k.table);
  const std::string near = nearest_name(key.str(), names);
  CaseProblem problem{name_, 0, 0, fmt::format("unknown key '{}'{}{}", key.str(),
                                               table.empty() ? "" : " in " + bracketed(table),
                                               near.empty() ? "" : fmt::format("; did you mean '{}'?", near))};
  if (key.source().begin.line > 0) {
    if (key.source().path) problem.file = *key.source().path;
    problem.line = int(key.source().begin.line);
    problem.column = int(key.source().begin.column);
  }
  problems_.push_back(problem);
}

void CaseReader::check_missing(const toml::table& table, std::string_view name, std::size_t, const toml::node& where) {
  for (const Key& key : keys())
    if (key.required && key.table == name && !table.contains(key.name))
      add(&where, fmt::format("{} is missing: {}", key.path(), key.help));
}

void CaseReader::read_table(const toml::table& table, std::string_view name, std::size_t index) {
  for (const auto& [key, node] : table) {
    const auto found = std::find_if(keys().begin(), keys().end(),
                                    [&](const Key& k) { return k.table == name && k.name == key.str(); });
    if (found == keys().end())
      wrong_key(key, name);
    else
      read_key(*found, index, node);
  }
  check_missing(table, name, index, table);
}

void CaseReader::read_effects(const toml::node& node) {
  const toml::table* table = node.as_table();
  if (table == nullptr) {
    add(&node, "effects: name the roles in a table [effects]; choosing them by itself is not in this version");
    return;
  }
  for (const auto& [name, value] : *table) {
    const auto role = std::find_if(roles_.begin(), roles_.end(), [&](const Role& r) { return r.name == name.str(); });
    if (role == roles_.end()) {
      wrong_key(name, "effects");
      continue;
    }
    const auto law = value.value_exact<std::string>();
    std::vector<std::string> laws{"none"};
    for (const Law& l : role->laws) laws.push_back(l.name);
    if (!law || std::find(laws.begin(), laws.end(), *law) == laws.end()) {
      const std::string near = law ? nearest_name(*law, laws) : "";
      add(&value, fmt::format("effects.{} = {}: allowed are {}{}", name.str(), shown(value), fmt::join(laws, " | "),
                              near.empty() ? "" : "; did you mean \"" + near + "\"?"));
      continue;
    }
    if (*law != "none") scene_.effects[role->name] = *law;
  }
}

void CaseReader::read_entry(std::string_view table, const toml::key& name, const toml::node& node) {
  const bool known = std::any_of(keys().begin(), keys().end(), [&](const Key& k) { return k.table == table; });
  if (!known) return wrong_key(name, "");
  if (is_array_of_tables(table)) {
    const toml::array* entries = node.as_array();
    if (entries == nullptr || !entries->is_homogeneous<toml::table>())
      return add(&node, fmt::format("{} is an array of tables: write [[{}]]", table, table));
    if (table == "species") scene_.species.resize(entries->size());
    if (table == "contact_pair") scene_.contact_pairs.resize(entries->size());
    for (std::size_t n = 0; n < entries->size(); ++n) read_table(*entries->get(n)->as_table(), table, n);
    return;
  }
  if (!node.is_table()) return add(&node, fmt::format("{} is a table: write [{}]", table, table));
  read_table(*node.as_table(), table, 0);
}

/// A value of the command line: TOML if it reads as such, else a text.
toml::table parse_override(const std::string& value, const std::string& source) {
  try {
    return toml::parse("value = " + value, source);
  } catch (const toml::parse_error&) {
    toml::table text;
    text.insert("value", value);
    return text;
  }
}

/// Puts "key=value" into the tree in place of what the file says.
void CaseReader::apply_override(toml::table& root, const std::string& given) {
  const std::size_t sign = given.find('=');
  const std::string path = given.substr(0, sign), source = "--set " + path;
  if (sign == std::string::npos || sign == 0)
    return problems_.push_back({"--set " + given, 0, 0, "expected KEY=VALUE"});
  const std::string value = given.substr(sign + 1);
  toml::table parsed = parse_override(value, source);
  std::vector<std::string> parts;
  std::stringstream stream(path);
  for (std::string part; std::getline(stream, part, '.');) parts.push_back(part);
  toml::node* at = &root;
  for (std::size_t n = 0; n + 1 < parts.size(); ++n) {
    if (toml::array* array = at->as_array()) {
      toml::node* chosen = nullptr;
      for (std::size_t m = 0; m < array->size(); ++m) {
        toml::table* entry = array->get(m)->as_table();
        if (std::to_string(m) == parts[n] || (entry && (*entry)["name"].value_or(std::string()) == parts[n])) chosen = entry;
      }
      if (chosen == nullptr)
        return problems_.push_back({source, 0, 0, fmt::format("no '{}' in [[{}]]", parts[n], parts[n - 1])});
      at = chosen;
      continue;
    }
    toml::table* table = at->as_table();
    if (table == nullptr) return problems_.push_back({source, 0, 0, "no such key"});
    if (!table->contains(parts[n])) table->insert(parts[n], toml::table{});
    at = table->get(parts[n]);
  }
  toml::table* last = at->as_table();
  if (last == nullptr) return problems_.push_back({source, 0, 0, "no such key"});
  last->insert_or_assign(parts.back(), std::move(*parsed.get("value")));
}

void CaseReader::read(toml::table& root, std::span<const std::string> overrides) {
  for (const std::string& given : overrides) apply_override(root, given);
  scene_.overrides.assign(overrides.begin(), overrides.end());
  for (const auto& [name, node] : root) {
    if (name.str() == "effects")
      read_effects(node);
    else if (const auto top = std::find_if(keys().begin(), keys().end(), [&](const Key& k) { return k.table.empty() && k.name == name.str(); });
             top != keys().end())
      read_key(*top, 0, node);
    else
      read_entry(name.str(), name, node);
  }
  for (std::string_view table : {"column", "fluid", "species", "bed", "run"})
    if (!root.contains(table)) add(nullptr, fmt::format("{} is missing", bracketed(table)));
}

Scene CaseReader::finish() {
  const auto given = [&](std::string_view path) { return std::find(given_.begin(), given_.end(), path) != given_.end(); };
  const bool by_particles = given("bed.particles");
  for (std::string_view key : {"bed.volume_share", "bed.static_height"}) {
    if (by_particles && given(key)) add(nullptr, fmt::format("{} and bed.particles both say how much there is: give one", key));
    if (!by_particles && !given(key)) add(nullptr, fmt::format("{} is missing (or give bed.particles)", key));
  }
  if (!given("bed.solids_fraction")) add(nullptr, "bed.solids_fraction is missing: of the settled bed");
  if (!scene_.column.closed && !given("inlet.superficial_velocity"))
    add(nullptr, "inlet.superficial_velocity is missing (or set column.closed = true)");
  if (scene_.column.closed && given("inlet.superficial_velocity"))
    add(nullptr, "inlet.superficial_velocity cannot act: column.closed = true");
  if (problems_.empty()) {
    const std::vector<CaseProblem> more = resolve(scene_, name_, by_particles);
    problems_.insert(problems_.end(), more.begin(), more.end());
  }
  std::stable_sort(problems_.begin(), problems_.end(), [](const CaseProblem& a, const CaseProblem& b) {
    return std::pair(a.line == 0, a.line) < std::pair(b.line == 0, b.line);
  });
  if (!problems_.empty()) throw CaseError(problems_);
  return scene_;
}

}  // namespace

Scene parse_case(std::string_view text, const std::string& name, std::span<const std::string> overrides,
                 std::span<const Role> roles) {
  toml::table root;
  try {
    root = toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    std::vector<CaseProblem> problem;
    problem.push_back({name, int(at.line), int(at.column), std::string(error.description())});
    throw CaseError(problem);
  }
  CaseReader reader(name, roles);
  reader.read(root, overrides);
  return reader.finish();
}

Scene read_case(const std::filesystem::path& path, std::span<const std::string> overrides, std::span<const Role> roles) {
  constexpr std::uintmax_t largest = 10'000'000;
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw FileError(path.string() + " is a folder: name its case.toml");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(fmt::format("{}: cannot be read ({})", path.string(), std::strerror(errno)));
  if (const auto size = std::filesystem::file_size(path, error); !error && size > largest)
    throw FileError(fmt::format("{}: {} bytes is too long for a case file", path.string(), size));
  std::stringstream text;
  text << file.rdbuf();
  if (file.bad()) throw FileError(fmt::format("{}: cannot be read ({})", path.string(), std::strerror(errno)));
  return parse_case(text.str(), path.string(), overrides, roles);
}

}  // namespace polybed::core
