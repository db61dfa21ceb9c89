// polybed explain: explains one word of the program.
#include "app/explain.hpp"

#include <fmt/format.h>
#include <strings.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "app/options.hpp"
#include "core/error.hpp"
#include "core/print.hpp"
#include "dem/history_table.hpp"
#include "measures/bed_table.hpp"
#include "multiscale/roles.hpp"
#include "tfm/history_table.hpp"

namespace polybed::app {

core::Json json_of_key(const core::Key& key) {
  core::Json json = {{"key", key.path()},
                     {"kind", core::kind_name(key)},
                     {"unit", core::unit_name(key.dimension)},
                     {"range", core::range_text(key)},
                     {"required", key.required},
                     {"default", nullptr},
                     {"help", key.help}};
  if (!key.standard.empty()) json["default"] = key.standard;
  if (!key.equation.empty()) json["equation"] = key.equation;
  return json;
}

std::string beside(std::string line, std::size_t indent, const std::string& text) {
  constexpr std::size_t width = 100;
  std::string lines;
  std::stringstream words(text);
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > width) {
      lines += line + "\n";
      line = std::string(indent - 1, ' ');
    }
    line += " " + word;
  }
  return lines + line + "\n";
}

namespace {

/// One meaning of a word, as text and as JSON.
struct Meaning {
  std::string text;
  core::Json json;
};

constexpr const char* before_kind = "  (";

std::string title_of(const std::string& name, const std::string& kind) { return name + before_kind + kind + ")\n"; }

Meaning meaning_of(const core::Key& key) {
  std::string text = title_of(key.path(), "key of the case file");
  text += fmt::format("  {}\n  {}{}\n", key.help, core::kind_name(key), key.required ? ", required" : "");
  if (const std::string range = core::range_text(key); !range.empty()) text += fmt::format("  range: {}\n", range);
  if (!key.standard.empty()) text += fmt::format("  default: {}\n", key.standard);
  if (!key.equation.empty()) text += fmt::format("  {}\n", key.equation);
  return {text, json_of_key(key)};
}

Meaning meaning_of(const core::Table& table) {
  std::string text = title_of(core::header(table), "table of the case file");
  for (const core::Key& key : table.keys) text += fmt::format("  {:26} {}\n", key.name, key.help);
  return {text, {{"table", std::string(table.name)}}};
}

/// The laws of a role, recommended ones first.
std::vector<core::Law> in_order(const core::Role& role) {
  const auto place = [&](const core::Law& law) {
    return std::find_if(role.advice.begin(), role.advice.end(), [&](const auto& one) { return one.law == law.name; }) -
           role.advice.begin();
  };
  std::vector<core::Law> laws = role.laws;
  std::stable_sort(laws.begin(), laws.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  return laws;
}

Meaning meaning_of(const core::Role& role) {
  std::string text = title_of("effects." + role.name, "role in [effects]; acts in " + role.models);
  text += fmt::format("  {}\n", role.help);
  if (!role.absent.empty()) text += fmt::format("  in the other model: {}\n", role.absent);
  core::Json advice = core::Json::array();
  if (!role.advice.empty()) text += "  which to take:\n";
  for (const core::Advice& one : role.advice) {
    text += beside(fmt::format("    {:17}", one.law), 22, one.bed);
    advice.push_back({{"law", one.law}, {"bed", one.bed}});
  }
  text += "  laws, or \"none\", or \"auto\" for what polybed effects recommends:\n";
  for (const core::Law& law : in_order(role)) text += beside(fmt::format("    {:17}", law.name), 22, law.help);
  return {text, {{"role", role.name}, {"models", role.models}, {"help", role.help}, {"advice", advice}}};
}

Meaning meaning_of(const core::Role& role, const core::Law& law) {
  std::string text = title_of(law.name, "law of effects." + role.name);
  text += fmt::format("  {}\n", law.help);
  if (!law.note.empty()) text += fmt::format("  {}\n", law.note);
  if (!law.source.empty()) text += fmt::format("  source: {}\n", law.source);
  text += fmt::format("  in the case: [effects] {} = \"{}\"\n", role.name, law.name);
  return {text, {{"law", law.name}, {"role", role.name}, {"help", law.help}, {"source", law.source}}};
}

Meaning meaning_of(const Term& term) {
  std::string text = title_of(term.name, term.kind) + fmt::format("  {}\n", term.help);
  if (!term.todo.empty()) text += fmt::format("  to do: {}\n", term.todo);
  return {text, {{"term", term.name}, {"kind", term.kind}, {"help", term.help}, {"to_do", term.todo}}};
}

/// A column of history.csv that a case names: "centre_sand_m" for a measure of each species.
template <class Source>
bool is_of_a_species(const measures::Measure<Source>& measure, const std::string& word) {
  const std::string end = measures::Single<Source>{"", measure.unit, {}, {}}.column();
  return measure.of_species() && word.starts_with(measure.name + "_") && word.ends_with(end) &&
         word.size() > measure.name.size() + 1 + end.size();
}

/// "discharge1_m3_s" for "discharge2_m3_s", likewise for other columns of a way out: one entry explains all of them.
std::string as_of_first_exit(const std::string& word) {
  return std::regex_replace(word, std::regex("^(discharge[0-9]+|top)_"), "discharge1_");
}

template <class Source>
void add_measures(const measures::Table<Source>& table, const std::string& word, bool of_species,
                  std::vector<Meaning>& found, std::vector<std::string>& names) {
  for (const measures::Measure<Source>& measure : table) {
    names.push_back(measure.name);
    const std::string column = measures::Single<Source>{measure.name, measure.unit, {}, {}}.column();
    if (word != measure.name && word != column && !(of_species && is_of_a_species(measure, word))) continue;
    found.push_back({title_of(measure.name, "measure, unit " + measure.unit) + "  " + measure.help + "\n",
                     {{"measure", measure.name}, {"unit", measure.unit}, {"help", measure.help}}});
  }
}

/// "dem" and "effects.drag" as users type them: the name of a role without its table.
std::string without_table(const std::string& word) {
  const std::string front = "effects.";
  return word.starts_with(front) ? word.substr(front.size()) : word;
}

/// Of a column of history.csv.
std::vector<Meaning> meanings_of_column(const std::string& word, bool of_species, std::vector<std::string>& names) {
  std::vector<Meaning> found;
  add_measures(measures::bed_table(), word, of_species, found, names);
  add_measures(tfm::whole_history_table(), word, of_species, found, names);
  add_measures(dem::whole_history_table(), word, of_species, found, names);
  return found;
}

std::vector<Meaning> meanings_of(const std::string& word, std::vector<std::string>& names) {
  std::vector<Meaning> found;
  for (const core::Key& key : core::keys()) {
    names.push_back(key.path());
    names.emplace_back(key.name);
    if (word == key.path()) return {meaning_of(key)};
    if (word == key.name) found.push_back(meaning_of(key));
  }
  for (const core::Table& table : core::tables())
    if (!table.name.empty() && word == table.name) found.push_back(meaning_of(table));
  for (const core::Role& role : all_roles()) {
    names.push_back(role.name);
    if (without_table(word) == role.name) found.push_back(meaning_of(role));
    for (const core::Law& law : role.laws) {
      names.push_back(law.name);
      if (word == law.name) found.push_back(meaning_of(role, law));
    }
  }
  for (const Term& term : terms()) {
    names.push_back(term.name);
    if (word == term.name) found.push_back(meaning_of(term));
  }
  for (Meaning& meaning : meanings_of_column(word, false, names)) found.push_back(std::move(meaning));
  return found;
}

}  // namespace

void run_explain(const std::string& word, bool json) {
  std::vector<std::string> names;
  std::vector<Meaning> found = meanings_of(word, names);
  if (found.empty()) {  // a card prints names of states with spaces
    std::string joined = word;
    std::replace(joined.begin(), joined.end(), ' ', '_');
    found = meanings_of(joined, names);
  }
  if (found.empty()) found = meanings_of_column(as_of_first_exit(word), true, names);
  for (const Term& term : terms())  // "geldart" for "Geldart class"
    if (found.empty() && !word.empty() && strncasecmp(term.name.c_str(), (word + " ").c_str(), word.size() + 1) == 0)
      found.push_back(meaning_of(term));
  if (found.empty()) {
    const std::string near = core::nearest_name(word, names);
    throw core::CaseError("nothing to explain is called '" + word + "'" +
                          (near.empty() ? "; see polybed schema and polybed list" : "; did you mean '" + near + "'?"));
  }
  if (json) {
    core::Json all = core::Json::array();
    for (const Meaning& meaning : found) all.push_back(meaning.json);
    return core::print("{}\n", core::json_text(found.size() == 1 ? all.front() : core::Json{{"meanings", all}}));
  }
  for (std::size_t n = 0; n < found.size(); ++n) {
    const std::string& text = found[n].text;
    const std::size_t name = text.find(before_kind);
    if (n > 0) core::print("\n");
    core::put(stdout, core::Colour::bold, text.substr(0, name));
    core::put(stdout, text.substr(name));
  }
}

}  // namespace polybed::app
