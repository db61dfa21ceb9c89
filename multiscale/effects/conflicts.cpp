#include "multiscale/effects/conflicts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "core/files.hpp"

namespace polybed::multiscale {

namespace {

/// A law of a role that cannot stand beside a law of another; "*": any law.
struct Conflict {
  const char *role, *law, *other, *other_law, *why;
};

constexpr Conflict conflicts[] = {
    {"magnus", "*", "contact", "hertz", "a force of rotation, and nothing rotates without friction"},
    {"rolling", "*", "contact", "hertz", "a resistance to rotation, and nothing rotates without friction"},
    {"cohesion", "jkr", "contact", "linear", "it stands in place of Hertz' force, which linear springs have not"},
    {"granular_temperature", "*", "solids_stress", "frictional", "fluctuations act through the kinetic stress alone"}};

bool fits(const char* wanted, const std::string& law) {
  return std::string(wanted) == "*" ? law != "none" && law != core::automatic : law == wanted;
}

/// Line and column of a role in [effects], from 1; 0 if it stands elsewhere, as in an inline table.
std::pair<int, int> place_of(const std::string& text, const std::string& role) {
  std::istringstream lines(text);
  std::string line;
  bool within = false;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string::npos) continue;
    if (line[first] == '[') within = line.compare(first, 9, "[effects]") == 0;
    const std::size_t end = line.find_first_of(" \t=", first);
    if (within && end != std::string::npos && line.substr(first, end - first) == role) return {number, int(first) + 1};
  }
  return {0, 0};
}

core::CaseProblem problem(const core::Scene& scene, const std::string& text, const std::string& name,
                          const std::string& role, const std::string& message) {
  const std::string key = "effects." + role;
  const bool overridden = std::any_of(scene.overrides.begin(), scene.overrides.end(),
                                      [&](const std::string& given) { return given.starts_with(key + "="); });
  if (overridden) return {"--set " + key, 0, 0, message};
  const auto [line, column] = place_of(text, role);
  return {name, line, column, message};
}

}  // namespace

std::vector<core::CaseProblem> role_conflicts(const core::Scene& scene, const std::string& text,
                                              const std::string& name) {
  std::vector<core::CaseProblem> problems;
  for (const Conflict& c : conflicts) {
    const std::string law = core::law_of(scene, c.role), other = core::law_of(scene, c.other);
    if (!fits(c.law, law) || !fits(c.other_law, other)) continue;
    problems.push_back(problem(
        scene, text, name, c.role,
        fmt::format("effects.{} = \"{}\" cannot be with effects.{} = \"{}\": {}", c.role, law, c.other, other, c.why)));
    problems.push_back(
        problem(scene, text, name, c.other,
                fmt::format("effects.{} = \"{}\" cannot be with effects.{} = \"{}\"", c.other, other, c.role, law)));
  }
  return problems;
}

void refuse_role_conflicts(const core::Scene& scene, const std::filesystem::path& path) {
  const std::string text = core::read_text(path);
  const std::vector<core::CaseProblem> problems = role_conflicts(scene, text, path.string());
  if (!problems.empty()) throw core::CaseError(problems);
}

}  // namespace polybed::multiscale
