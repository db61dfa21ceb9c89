#include "multiscale/effects/conflicts.hpp"

#include <fmt/format.h>

#include <string>

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

}  // namespace

std::vector<core::SceneFault> role_conflicts(const core::Scene& scene) {
  std::vector<core::SceneFault> faults;
  for (const Conflict& c : conflicts) {
    const std::string law = core::law_of(scene, c.role), other = core::law_of(scene, c.other);
    if (!fits(c.law, law) || !fits(c.other_law, other)) continue;
    const std::string role = std::string("effects.") + c.role, against = std::string("effects.") + c.other;
    faults.push_back(
        {role, {against}, fmt::format("{} = \"{}\" cannot be with {} = \"{}\": {}", role, law, against, other, c.why)});
    faults.push_back(
        {against, {role}, fmt::format("{} = \"{}\" cannot be with {} = \"{}\"", against, other, role, law)});
  }
  return faults;
}

}  // namespace polybed::multiscale
