#include "dem/effects/maker.hpp"

namespace polybed::dem {

namespace {

relevance::Menu menu_of(const std::vector<const Maker*>& list) {
  relevance::Menu menu;
  for (const Maker* one : list) relevance::add(menu, *one->effect, "dem", one->slot);
  return menu;
}

}  // namespace

std::vector<core::Role> roles() { return relevance::roles_of(menu_of(effects())); }

std::vector<core::Rule> rules(const std::vector<const Maker*>& list) { return relevance::rules_of(menu_of(list)); }

}  // namespace polybed::dem
