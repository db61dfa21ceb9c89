#include "core/case/override.hpp"

#include <fmt/format.h>

#include <array>
#include <sstream>
#include <string_view>

#include "core/case/depth.hpp"

namespace polybed::core {

namespace {

/// A value from the command line: TOML if it parses as TOML, else a text.
toml::table parse_override(const std::string& value, const std::string& source) {
  try {
    toml::table parsed = toml::parse("value = " + value, source);
    if (parsed.size() == 1) return parsed;  // a line end and a second key would be ignored
  } catch (const toml::parse_error&) {
  }
  std::ostringstream quoted;
  quoted << toml::table{{"value", value}};
  return toml::parse(quoted.str(), source);
}

/// Keys of which a case gives one: an override of one replaces what the file says by the other.
constexpr std::array<std::array<std::string_view, 3>, 1> one_of{{{"inlet", "superficial_velocity", "flow_rate"}}};

void leave_out_other(toml::table& table, const std::vector<std::string>& path) {
  for (const auto& [name, first, second] : one_of) {
    if (path.size() != 2 || path[0] != name || (path[1] != first && path[1] != second)) continue;
    const std::string_view other = path[1] == first ? second : first;
    const toml::node* given = table.get(other);
    const bool by_override = given && given->source().path && given->source().path->starts_with("--set ");
    if (!by_override) table.erase(other);
  }
}

}  // namespace

void apply_override(toml::table& root, const std::string& given, CaseValues& values) {
  const std::size_t sign = given.find('=');
  const std::string path = given.substr(0, sign), source = "--set " + path;
  if (sign == std::string::npos || sign == 0)
    return values.problems().push_back({"--set " + given, 0, 0, "expected KEY=VALUE"});
  const std::string value = given.substr(sign + 1);
  for (const std::string& text : {path, value})
    if (auto problem = too_deep(text, source)) {
      problem->line = 0;
      return values.problems().push_back(*problem);
    }
  toml::table parsed;
  try {
    parsed = parse_override(value, source);
  } catch (const toml::parse_error& error) {
    return values.problems().push_back({source, 0, 0, std::string(error.description())});
  }
  const toml::source_region here = parsed.get("value")->source();
  std::vector<std::string> parts;
  std::stringstream stream(path);
  for (std::string part; std::getline(stream, part, '.');) parts.push_back(part);
  toml::node* at = &root;
  for (std::size_t n = 0; n + 1 < parts.size(); ++n) {
    if (toml::array* array = at->as_array()) {
      toml::node* chosen = nullptr;
      for (std::size_t m = 0; m < array->size(); ++m) {
        toml::table* entry = array->get(m)->as_table();
        if (std::to_string(m) == parts[n] || (entry && (*entry)["name"].value_or(std::string()) == parts[n]))
          chosen = entry;
      }
      if (chosen == nullptr)
        return values.problems().push_back({source, 0, 0, fmt::format("no '{}' in [[{}]]", parts[n], parts[n - 1])});
      at = chosen;
      continue;
    }
    toml::table* table = at->as_table();
    if (table == nullptr) return values.problems().push_back({source, 0, 0, "no such key"});
    if (!table->contains(parts[n])) table->insert(toml::key(parts[n], here), toml::table{});
    at = table->get(parts[n]);
  }
  toml::table* last = at->as_table();
  if (last == nullptr) return values.problems().push_back({source, 0, 0, "no such key"});
  last->erase(parts.back());
  leave_out_other(*last, parts);
  last->insert(toml::key(parts.back(), here), std::move(*parsed.get("value")));
}

}  // namespace polybed::core
