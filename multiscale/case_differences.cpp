#include "multiscale/case_differences.hpp"

#include <algorithm>
#include <map>
#include <sstream>

namespace polybed::multiscale {

namespace {

/// Values by key of a case as core::resolved_case writes it, one key a line; tables of an array are counted from 1.
std::map<std::string, std::string> keys_of(const std::string& text) {
  std::map<std::string, std::string> keys;
  std::map<std::string, int> counted;
  std::string table;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[[")) {
      const std::string name = line.substr(2, line.find(']') - 2);
      table = name + "." + std::to_string(++counted[name]) + ".";
    } else if (line.starts_with("[")) {
      table = line.substr(1, line.find(']') - 1) + ".";
    } else if (const std::size_t sign = line.find(" = "); sign != std::string::npos) {
      keys[table + line.substr(0, sign)] = line.substr(sign + 3);
    }
  }
  return keys;
}

bool acts_in_both(const std::string& name, std::span<const core::Role> roles) {
  bool tfm = false, dem = false;
  for (const core::Role& role : roles) {
    if (role.name != name) continue;
    tfm = tfm || role.models.find("tfm") != std::string::npos;
    dem = dem || role.models.find("dem") != std::string::npos;
  }
  return tfm && dem;
}

bool may_differ(const std::string& key, std::span<const core::Role> roles) {
  if (key == "title" || key == "run.until") return true;
  const std::string effects = "effects.";
  if (key.starts_with(effects)) return !acts_in_both(key.substr(effects.size()), roles);
  return key.starts_with("tfm.") || key.starts_with("dem.") || key.starts_with("output.");
}

}  // namespace

std::vector<Difference> case_differences(const std::string& first, const std::string& second,
                                         std::span<const core::Role> roles) {
  const auto a = keys_of(first), b = keys_of(second);
  std::map<std::string, Difference> found;
  const auto value = [](const auto& keys, const std::string& key) {
    const auto entry = keys.find(key);
    return entry == keys.end() ? std::string("-") : entry->second;
  };
  for (const auto* keys : {&a, &b})
    for (const auto& [key, unused] : *keys)
      if (value(a, key) != value(b, key) && !may_differ(key, roles)) found[key] = {key, value(a, key), value(b, key)};
  std::vector<Difference> list;
  for (auto& [key, difference] : found) list.push_back(std::move(difference));
  return list;
}

}  // namespace polybed::multiscale
