#include "core/case/file.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/case/case_rules.hpp"
#include "core/case/depth.hpp"
#include "core/case/keys.hpp"
#include "core/case/override.hpp"
#include "core/case/removed.hpp"
#include "core/case/resolve.hpp"
#include "core/case/values.hpp"
#include "core/output/checkpoint.hpp"
#include "core/output/files.hpp"

namespace polybed::core {

namespace {

/// Particles of each species in the checkpoint that a bed starts from. Empty for any other start, and if the checkpoint
/// does not exist yet, is damaged or does not contain the numbers: the case must then give them.
std::vector<std::int64_t> counted_in_checkpoint(const Start& start) {
  if (start.kind != StartKind::checkpoint) return {};
  std::vector<std::int64_t> numbers;
  try {
    for (const double number : read_array(start.file, particle_numbers)) {
      if (!(number >= 0 && number < 9e15)) return {};
      numbers.push_back(std::int64_t(number));
    }
  } catch (const FileError&) {
    return {};
  }
  return numbers;
}

/// One reading of a case: the scene as it grows, and the problems found so far.
class CaseReader {
 public:
  CaseReader(std::string name, std::span<const Role> roles, const ClassRule& classes, const Rulebook& rules,
             OtherRoles others)
      : name_(std::move(name)), roles_(roles), classes_(classes), rules_(rules), others_(others), values_(name_) {
    scene_.places = Places(name_);
  }

  void read(toml::table& root, std::span<const std::string> overrides) {
    spell_out_effects(root);
    for (const std::string& given : overrides) apply_override(root, given, values_);
    scene_.overrides.assign(overrides.begin(), overrides.end());
    const Key& title = find_table("")->keys.front();
    for (const auto& [name, node] : root) {
      add_places_of_table(name, node);
      if (name.str() == "effects")
        read_effects(node);
      else if (name.str() == title.name)
        read_key(title, 0, node);
      else
        read_entry(name.str(), name, node);
    }
    leave_others_to_chooser();
    for (std::string_view table : {"column", "fluid", "species", "run"})
      if (!root.contains(table)) wrong_table(table, {}, fmt::format("{} is missing", header(*find_table(table))));
    if (!root.contains("bed") && !root.contains("layer"))
      wrong_table("bed", {}, "[bed] is missing: what lies in the column at the start; or give its layers as [[layer]]");
  }

  Scene finish() {
    check_amount();
    check_fluid();
    check_scene();
    std::vector<CaseProblem>& problems = values_.problems();
    std::stable_sort(problems.begin(), problems.end(), [](const CaseProblem& a, const CaseProblem& b) {
      return std::pair(a.line == 0, a.line) < std::pair(b.line == 0, b.line);
    });
    if (!problems.empty()) throw CaseError(problems);
    return scene_;
  }

 private:
  void add_place(const std::string& path, std::size_t entry, const toml::source_region& region) {
    scene_.places.add(path, entry, values_.place_of(region));
  }

  void add_places_of_table(const toml::key& name, const toml::node& node) {
    const toml::array* entries = node.as_array();
    if (entries == nullptr) return add_place(std::string(name.str()), 0, name.source());
    for (std::size_t n = 0; n < entries->size(); ++n) add_place(std::string(name.str()), n, entries->get(n)->source());
  }

  void read_table(const toml::table& table, const Table& known, std::size_t index) {
    for (const auto& [key, node] : table) {
      const auto found =
          std::find_if(known.keys.begin(), known.keys.end(), [&](const Key& k) { return k.name == key.str(); });
      if (found == known.keys.end())
        wrong_key(key, known.name);
      else
        read_key(*found, index, node);
    }
    for (const Key& key : known.keys)
      if (key.required && !table.contains(key.name)) {
        values_.add(table.source(), fmt::format("{} is missing: {}", key.path(), key.help));
        wrong_.add(key.path());
      }
    const std::size_t problems = values_.problems().size();
    if (known.name == "species") check_sizes(table);
    if (values_.problems().size() > problems) wrong_.add("species.diameter");
  }

  void read_entry(std::string_view table, const toml::key& name, const toml::node& node) {
    const Table* known = find_table(table);
    if (known == nullptr) return wrong_key(name, "");
    if (!known->array) {
      if (!node.is_table())
        return wrong_table(table, node.source(), fmt::format("{} is a table: write [{}]", table, table));
      return read_table(*node.as_table(), *known, 0);
    }
    const toml::array* entries = node.as_array();
    if (entries == nullptr || !entries->is_homogeneous<toml::table>())
      return wrong_table(table, node.source(), fmt::format("{} is an array of tables: write [[{}]]", table, table));
    known->resize(scene_, entries->size());
    for (std::size_t n = 0; n < entries->size(); ++n) read_table(*entries->get(n)->as_table(), *known, n);
  }

  /// Replaces effects = "auto" by a table with every role left to the chooser: a command line can then set one.
  void spell_out_effects(toml::table& root) const {
    const toml::node* effects = root.get("effects");
    if (effects == nullptr || effects->value_exact<std::string>() != automatic) return;
    const toml::source_region here = effects->source();
    toml::table roles;
    for (const Role& role : roles_) roles.insert(toml::key(role.name, here), automatic);
    root.insert_or_assign(toml::key("effects", here), std::move(roles));
  }

  void read_effects(const toml::node& node) {
    const toml::table* table = node.as_table();
    if (table == nullptr) {
      values_.add(node.source(), "effects: a table [effects] that names roles, or effects = \"auto\" at the top");
      return;
    }
    for (const auto& [name, value] : *table) {
      if (name.str() == other_roles) {
        read_others(value);
        continue;
      }
      add_place(fmt::format("effects.{}", name.str()), 0, name.source());
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
        std::string hint = law ? instead_of_removed(fmt::format("effects.{}", name.str()), *law) : "";
        if (hint.empty() && !near.empty()) hint = "; did you mean \"" + near + "\"?";
        values_.add(value.source(), fmt::format("effects.{} = {}: allowed are {}{}", name.str(), shown(value),
                                                fmt::join(laws, " | "), hint));
        wrong_.add("effects." + role->name);
        continue;
      }
      if (*law != "none") scene_.effects[role->name] = *law;
    }
  }

  void read_others(const toml::node& value) {
    const auto word = value.value_exact<std::string>();
    if (word != automatic && word != "none")
      values_.add(value.source(),
                  fmt::format("effects.{} = {}: allowed are auto | none: what becomes of the roles that the case does "
                              "not name",
                              other_roles, shown(value)));
    others_ = word == "none" ? OtherRoles::off : OtherRoles::chosen;
  }

  void leave_others_to_chooser() {
    if (others_ == OtherRoles::off) return;
    for (const Role& role : roles_)
      if (!is_given("effects." + role.name)) scene_.effects.emplace(role.name, automatic);
  }
  void read_key(const Key& key, std::size_t index, const toml::node& node) {
    add_place(key.path(), index, node.source());
    const std::size_t problems = values_.problems().size();
    const Value value = values_.read(key, node);
    if (!std::holds_alternative<std::monostate>(value)) key.set(scene_, index, value);
    if (values_.problems().size() == problems) return;
    wrong_.add(key.path());
    if (key.path() == "chooser.monitor" && node.value_exact<std::string>() == "enable")
      values_.problems().back().message +=
          "; a run switches no effect on by itself any more: use \"stop\", then resume it with the effect on, "
          "--resume --set effects.ROLE=LAW";
  }

  /// Checks that the case gives the amount of solids exactly once. The layers of a bed give it, if it starts in them.
  void check_amount() {
    const auto given = [&](const std::string& path) { return is_given(path); };
    const bool by_layers = given("layer");
    if (!scene_.layers.empty() && !given("bed.start")) scene_.bed.start.kind = StartKind::layered;
    const bool by_particles = given("bed.particles"), list = scene_.bed.start.kind == StartKind::list;
    const bool unsaid = !by_layers && !by_particles && !given("bed.volume_share") && !given("bed.static_height");
    if (unsaid && wrong_.sound("bed.start")) scene_.bed.particles = counted_in_checkpoint(scene_.bed.start);
    const bool counted = !scene_.bed.particles.empty();
    for (const char* key : {"bed.volume_share", "bed.static_height"}) {
      if (by_particles && given(key))
        add({"bed.particles"}, fmt::format("{} and bed.particles both say how much there is: give one", key));
      if (by_layers || by_particles || counted || given(key) || list || !wrong_.sound({key, "bed.start"})) continue;
      add({key}, fmt::format("{} is missing (or give bed.particles, or [[layer]]){}", key,
                             scene_.bed.start.kind == StartKind::checkpoint
                                 ? "; the checkpoint that the bed starts from does not say how many particles it has"
                                 : ""));
      wrong_.add(key);
    }
    // A feed is compared with the packing of the settled bed, however the bed starts.
    const bool anywhere = (unsaid && counted) || (scene_.bed.start.kind == StartKind::random && by_particles);
    if (given("bed.solids_fraction") || !wrong_.sound({"bed.solids_fraction", "bed.start"})) return;
    if ((list || anywhere) && scene_.feeds.empty()) return;
    const auto says_itself = [](const Layer& layer) { return layer.solids_fraction.has_value(); };
    if (by_layers && std::all_of(scene_.layers.begin(), scene_.layers.end(), says_itself)) return;
    add({"bed.solids_fraction"}, "bed.solids_fraction is missing: of the settled bed");
    wrong_.add("bed.solids_fraction");
  }

  /// A fluid with density and viscosity needs no name.
  void check_fluid() {
    const auto given = [&](const char* path) { return is_given(path); };
    if (given("fluid.name") || !wrong_.sound("fluid.name")) return;
    if (given("fluid.density") && given("fluid.viscosity")) return;
    add({"fluid.name"},
        "fluid.name is missing: \"water\" or \"air\" with fluid.temperature, \"none\" for particles without a fluid, "
        "or give fluid.density and fluid.viscosity");
    wrong_.add("fluid.name");
  }

  /// Checks that a species has one diameter or a distribution, and the distribution only the keys that its kind needs.
  void check_sizes(const toml::table& species) {
    const auto has = [&](const char* key) { return species.contains(key); };
    const std::string kind = species["distribution"].value_or(std::string());
    if (!has("diameter") && !has("distribution"))
      values_.add(species.source(), "species.diameter is missing: D_j of its spheres (or give species.distribution)");
    if (has("diameter") && has("distribution"))
      values_.add(species.get("diameter")->source(),
                  "species.diameter and species.distribution both say how large: give one");
    if (has("distribution") && kind != "lognormal" && kind != "sieves") return;  // reported like any wrong word
    const auto only = [&](const char* key, const std::string& of) {
      const bool acts = of.empty() ? !kind.empty() : kind == of;
      if (has(key) && !acts)
        values_.add(species.get(key)->source(), fmt::format("species.{} says nothing without species.distribution{}",
                                                            key, of.empty() ? "" : " = \"" + of + "\""));
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

  /// Fills in the keys that follow from others, between the rules that this depends on and the rest.
  void check_scene() {
    const auto has_sizes = [](const Species& species) { return species.sizes.kind.has_value(); };
    const auto by_sizes = [&] { return std::any_of(scene_.species.begin(), scene_.species.end(), has_sizes); };
    if (by_sizes() && wrong_.sound({"species.", "bed.volume_share"})) {
      if (classes_)
        expand_size_classes(scene_, classes_);
      else
        values_.add("species.distribution: this program knows no classes");
    }
    if (by_sizes() || !wrong_.sound("species.distribution"))
      wrong_.add("species.diameter");  // a distribution without classes has no diameter
    for (const Rule& rule : case_rules())
      if (rule.first && judge(rule)) wrong_.add(rule.keys.front());
    resolve(scene_, name_, wrong_);
    for (const Rule& rule : case_rules())
      if (!rule.first) judge(rule);
    add(rules_.refusals(scene_, wrong_, !values_.problems().empty()));
  }

  /// Judges a rule whose keys are sound, and reports it if the scene breaks it.
  bool judge(const Rule& rule) {
    const std::vector<CaseProblem> problems = problems_of({&rule, 1}, scene_, wrong_);
    add(problems);
    return !problems.empty();
  }

  void add(std::initializer_list<std::string> keys, std::string message) {
    values_.problems().push_back(scene_.places.problem(keys, std::move(message)));
  }
  void add(const std::vector<CaseProblem>& problems) {
    values_.problems().insert(values_.problems().end(), problems.begin(), problems.end());
  }

  [[nodiscard]] bool is_given(const std::string& path) const { return scene_.places.has(path); }

  /// Marks the keys of an unreadable table as missing.
  void wrong_table(std::string_view table, const toml::source_region& place, const std::string& message) {
    values_.add(place, message);
    for (const Key& key : find_table(table)->keys) wrong_.add(key.path());
  }
  /// The first key of that name in a table, after the table and a point; empty: there is none.
  [[nodiscard]] std::string key_in_a_table(std::string_view name) const {
    for (const Role& role : roles_)
      if (role.name == name) return fmt::format("effects.{}", name);
    for (const Table& t : tables())
      for (const Key& k : t.keys)
        if (!t.name.empty() && k.name == name) return fmt::format("{}.{}", t.name, name);
    return "";
  }
  void wrong_key(const toml::key& key, std::string_view table) {
    std::vector<std::string> names;
    const Table* known = find_table(table);
    if (known != nullptr)
      for (const Key& k : known->keys) names.emplace_back(k.name);
    if (table == "effects")
      for (const Role& role : roles_) names.push_back(role.name);
    if (table.empty())
      for (const Table& t : tables()) names.emplace_back(t.name);
    std::string near = nearest_name(key.str(), names);
    if (const std::string inside = table.empty() ? key_in_a_table(key.str()) : ""; !inside.empty()) near = inside;
    constexpr std::size_t few = 8;  // names that fit on a line
    std::string hint = instead_of_removed(fmt::format("{}.{}", table, key.str()));
    if (hint.empty() && !near.empty())
      hint = fmt::format("; did you mean '{}'?", near);
    else if (hint.empty() && !names.empty() && names.size() <= few)
      hint = fmt::format("; there {} {}", names.size() == 1 ? "is" : "are", fmt::join(names, ", "));
    values_.add(
        key.source(),
        fmt::format("unknown key '{}'{}{}", key.str(),
                    table.empty() ? "" : " in " + (known == nullptr ? fmt::format("[{}]", table) : header(*known)),
                    hint));
  }

  std::string name_;
  std::span<const Role> roles_;
  const ClassRule& classes_;
  const Rulebook& rules_;
  OtherRoles others_;
  CaseValues values_;
  Scene scene_;
  WrongKeys wrong_;
};

}  // namespace

Scene parse_case(std::string_view text, const std::string& name, std::span<const std::string> overrides,
                 std::span<const Role> roles, const ClassRule& classes, const Rulebook& rules, OtherRoles others) {
  if (const auto problem = too_deep(text, name)) throw CaseError(std::vector{*problem});
  toml::table root;
  try {
    root = toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    std::vector<CaseProblem> problem;
    problem.push_back({name, int(at.line), int(at.column), std::string(error.description())});
    throw CaseError(problem);
  }
  CaseReader reader(name, roles, classes, rules, others);
  reader.read(root, overrides);
  return reader.finish();
}

Scene read_case(const std::filesystem::path& path, std::span<const std::string> overrides, std::span<const Role> roles,
                const ClassRule& classes, const Rulebook& rules, OtherRoles others) {
  constexpr std::size_t largest = 10'000'000;
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw FileError(path.string() + " is a folder: name its case.toml");
  return parse_case(read_text(path, largest), path.string(), overrides, roles, classes, rules, others);
}

}  // namespace polybed::core
