#include "multiscale/effects/switching.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>

namespace polybed::multiscale {

namespace {

/// With the law that each is weighed by.
constexpr std::array<std::pair<const char*, const char*>, 2> switchable{
    {{"lift", "saffman_mei"}, {"magnus", "rubinow_keller"}}};

}  // namespace

bool can_be_switched(const std::string& effect) {
  return std::any_of(switchable.begin(), switchable.end(), [&](const auto& pair) { return effect == pair.first; });
}

core::Scene at_time(core::Scene scene, const std::vector<Switch>& switches, double time) {
  for (const Switch& one : switches)
    for (const auto& [effect, law] : switchable)
      if (one.effect == effect && one.time <= time) scene.effects[one.effect] = law;
  return scene;
}

double next_switch(const std::vector<Switch>& switches, double time) {
  double next = std::numeric_limits<double>::infinity();
  for (const Switch& one : switches)
    if (one.time > time) next = std::min(next, one.time);
  return next;
}

std::string text_of(const std::vector<Switch>& switches) {
  std::string text;
  for (const Switch& one : switches) text += fmt::format("{} {:.17g}\n", one.effect, one.time);
  return text;
}

std::vector<Switch> switches_of(const std::string& text) {
  std::vector<Switch> switches;
  std::istringstream words(text);
  for (Switch one{}; words >> one.effect >> one.time;) switches.push_back(one);
  return switches;
}

}  // namespace polybed::multiscale
