#include "core/case_file.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/case_override.hpp"
#include "core/case_values.hpp"
#include "core/keys.hpp"
#include "core/resolve_particles.hpp"

namespace polybed::core {

namespace {

/// One reading of a case: the scene as it grows, and the problems found so far.
class CaseReader {
 public:
  CaseReader(std::string name, std::span<const Role> roles, const ClassRule& classes)
      : name_(std::move(name)), roles_(roles), classes_(classes), values_(name_) {}

  void read(toml::table& root, std::span<const std::string> overrides);
  Scene finish();

 private:
  void read_table(const toml::table& table, std::string_view name, std::size_t index);
  void read_entry(std::string_view table, const toml::key& name, const toml::node& node);
  void read_effects(const toml::node& node);
  void read_key(const Key& key, std::size_t index, const toml::node& node);
  void check_given();
  void check_sizes(const toml::table& species);
  void wrong_key(const toml::key& key, std::string_view table);

  std::string name_;
  std::span<const Role> roles_;
  const ClassRule& classes_;
  CaseValues values_;
  Scene scene_;
  std::vector<std::string> given_;  ///< paths of the keys that the case sets
};

/// A name as people write it: [table] or [[array]].
std::string bracketed(std::string_view table) {
  return is_array_of_tables(table) ? fmt::format("[[{}]]", table) : fmt::format("[{}]", table);
}

bool contains(const std::vector<std::string>& paths, std::string_view path) {
  return std::find(paths.begin(), paths.end(), path) != paths.end();
}

void CaseReader::read_key(const Key& key, std::size_t index, const toml::node& node) {
  given_.push_back(key.path());
  const auto store = [&]<class T>(T& place, const auto& value) {
    if (value) place = static_cast<T>(*value);
  };
  std::visit(
      [&](auto at) {
        auto& place = at(scene_, index);
        using T = std::remove_reference_t<decltype(place)>;
        if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>>)
          store(place, values_.number(key, node));
        else if constexpr (std::is_same_v<T, int> || std::is_same_v<T, std::uint64_t>)
          store(place, values_.count(key, node));
        else if constexpr (std::is_same_v<T, bool>)
          store(place, values_.truth(key, node));
        else if constexpr (std::is_same_v<T, std::string>)
          store(place, values_.text(key, node));
        else if constexpr (std::is_same_v<T, std::vector<double>>)
          store(place, values_.numbers(key, node));
        else if constexpr (std::is_same_v<T, std::vector<std::int64_t>>)
          store(place, values_.counts(key, node));
        else if constexpr (std::is_same_v<T, std::vector<std::string>>)
          store(place, values_.texts(key, node));
        else
          store(place, key.by_size ? values_.sieves(key, node) : values_.points(key, node));
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
  values_.add(key.source(),
              fmt::format("unknown key '{}'{}{}", key.str(), table.empty() ? "" : " in " + bracketed(table),
                          near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
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
  for (const Key& key : keys())
    if (key.required && key.table == name && !table.contains(key.name))
      values_.add(table.source(), fmt::format("{} is missing: {}", key.path(), key.help));
  if (name == "species") check_sizes(table);
}

/// A species has one diameter or a distribution, and a distribution what its kind needs and nothing else.
void CaseReader::check_sizes(const toml::table& species) {
  const auto has = [&](const char* key) { return species.contains(key); };
  const std::string kind = species["distribution"].value_or(std::string());
  if (!has("diameter") && !has("distribution"))
    values_.add(species.source(), "species.diameter is missing: D_j of its spheres (or give species.distribution)");
  if (has("diameter") && has("distribution"))
    values_.add(species.get("diameter")->source(),
                "species.diameter and species.distribution both say how large: give one");
  if (has("distribution") && kind != "lognormal" && kind != "sieves") return;  // told as any wrong word
  const auto only = [&](const char* key, const std::string& of) {
    const bool acts = of.empty() ? !kind.empty() : kind == of;
    if (has(key) && !acts)
      values_.add(species.get(key)->source(), fmt::format("species.{} says nothing without species.distribution{}", key,
                                                          of.empty() ? "" : " = \"" + of + "\""));
  };
  for (const char* key : {"median", "mean", "deviation"}) only(key, "lognormal");
  only("sieves", "sieves");
  only("classes", "");
  const auto missing = [&](const std::string& what) {
    values_.add(species.get("distribution")->source(),
                fmt::format("species.distribution = \"{}\" needs {}", kind, what));
  };
  if (kind == "lognormal" && !has("deviation")) missing("species.deviation");
  if (kind == "lognormal" && has("median") == has("mean")) missing("either species.median or species.mean");
  if (kind == "sieves" && !has("sieves")) missing("species.sieves");
}

void CaseReader::read_effects(const toml::node& node) {
  const toml::table* table = node.as_table();
  if (table == nullptr) {
    if (node.value_exact<std::string>() != automatic)
      values_.add(node.source(), "effects: a table [effects] that names roles, or effects = \"auto\" at the top");
    else
      for (const Role& role : roles_) scene_.effects[role.name] = automatic;
    return;
  }
  for (const auto& [name, value] : *table) {
    const auto role = std::find_if(roles_.begin(), roles_.end(), [&](const Role& r) { return r.name == name.str(); });
    if (role == roles_.end()) {
      wrong_key(name, "effects");
      continue;
    }
    const auto law = value.value_exact<std::string>();
    std::vector<std::string> laws{"none", automatic};
    for (const Law& l : role->laws) laws.push_back(l.name);
    if (!law || std::none_of(laws.begin(), laws.end(), [&](const auto& l) { return fits_word(l, *law); })) {
      const std::string near = law ? nearest_name(*law, laws) : "";
      values_.add(value.source(),
                  fmt::format("effects.{} = {}: allowed are {}{}", name.str(), shown(value), fmt::join(laws, " | "),
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
      return values_.add(node.source(), fmt::format("{} is an array of tables: write [[{}]]", table, table));
    if (table == "species") scene_.species.resize(entries->size());
    if (table == "contact_pair") scene_.contact_pairs.resize(entries->size());
    if (table == "jet") scene_.jets.resize(entries->size());
    if (table == "feed") scene_.feeds.resize(entries->size());
    for (std::size_t n = 0; n < entries->size(); ++n) read_table(*entries->get(n)->as_table(), table, n);
    return;
  }
  if (!node.is_table()) return values_.add(node.source(), fmt::format("{} is a table: write [{}]", table, table));
  read_table(*node.as_table(), table, 0);
}

void CaseReader::read(toml::table& root, std::span<const std::string> overrides) {
  for (const std::string& given : overrides) apply_override(root, given, values_);
  scene_.overrides.assign(overrides.begin(), overrides.end());
  for (const auto& [name, node] : root) {
    if (name.str() == "effects")
      read_effects(node);
    else if (const auto top = std::find_if(keys().begin(), keys().end(),
                                           [&](const Key& k) { return k.table.empty() && k.name == name.str(); });
             top != keys().end())
      read_key(*top, 0, node);
    else
      read_entry(name.str(), name, node);
  }
  for (std::string_view table : {"column", "fluid", "species", "bed", "run"})
    if (!root.contains(table)) values_.add(fmt::format("{} is missing", bracketed(table)));
}

/// What must be given together, or not together.
void CaseReader::check_given() {
  const auto given = [&](std::string_view path) { return contains(given_, path); };
  const bool by_particles = given("bed.particles"), list = is_list(scene_.bed);
  for (std::string_view key : {"bed.volume_share", "bed.static_height"}) {
    if (by_particles && given(key))
      values_.add(fmt::format("{} and bed.particles both say how much there is: give one", key));
    if (!by_particles && !given(key) && !list) values_.add(fmt::format("{} is missing (or give bed.particles)", key));
  }
  // A feed is held against the packing of the settled bed, whatever the bed begins as.
  const bool anywhere = scene_.bed.start == "random" && given("bed.particles");
  if (!given("bed.solids_fraction") && ((!list && !anywhere) || !scene_.feeds.empty()))
    values_.add("bed.solids_fraction is missing: of the settled bed");
  if (!scene_.column.closed && !given("inlet.superficial_velocity") && scene_.fluid.name != "none" &&
      scene_.dem.shear_rate == 0)
    values_.add("inlet.superficial_velocity is missing (or set column.closed = true)");
  if (scene_.column.closed && given("inlet.superficial_velocity"))
    values_.add("inlet.superficial_velocity cannot act: column.closed = true");
}

Scene CaseReader::finish() {
  check_given();
  std::vector<CaseProblem>& problems = values_.problems();
  if (problems.empty()) {
    std::vector<CaseProblem> more = expand_size_classes(scene_, classes_, name_);
    if (more.empty()) more = resolve(scene_, name_, contains(given_, "bed.particles"));
    problems.insert(problems.end(), more.begin(), more.end());
  }
  std::stable_sort(problems.begin(), problems.end(), [](const CaseProblem& a, const CaseProblem& b) {
    return std::pair(a.line == 0, a.line) < std::pair(b.line == 0, b.line);
  });
  if (!problems.empty()) throw CaseError(problems);
  return scene_;
}

}  // namespace

Scene parse_case(std::string_view text, const std::string& name, std::span<const std::string> overrides,
                 std::span<const Role> roles, const ClassRule& classes) {
  toml::table root;
  try {
    root = toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    std::vector<CaseProblem> problem;
    problem.push_back({name, int(at.line), int(at.column), std::string(error.description())});
    throw CaseError(problem);
  }
  CaseReader reader(name, roles, classes);
  reader.read(root, overrides);
  return reader.finish();
}

Scene read_case(const std::filesystem::path& path, std::span<const std::string> overrides, std::span<const Role> roles,
                const ClassRule& classes) {
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
  return parse_case(text.str(), path.string(), overrides, roles, classes);
}

}  // namespace polybed::core
