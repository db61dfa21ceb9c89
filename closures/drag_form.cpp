#include "closures/drag_form.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace polybed::closures {

namespace {

template <class Constants>
using Members = std::span<const std::pair<const char*, double Constants::*>>;

Members<CelloConstants> members_of(const CelloConstants&) {
  using K = CelloConstants;
  static constexpr std::pair<const char*, double K::*> members[] = {
      {"k1_linear", &K::k1_linear},
      {"k1_square", &K::k1_square},
      {"k1_below", &K::k1_below},
      {"k2_linear", &K::k2_linear},
      {"k2_square", &K::k2_square},
      {"k2_below_linear", &K::k2_below_linear},
      {"k2_below_square", &K::k2_below_square},
      {"k3_voidage", &K::k3_voidage},
      {"k3_dense", &K::k3_dense},
      {"k3_voidage_square", &K::k3_voidage_square},
      {"k3_reynolds", &K::k3_reynolds},
      {"pole_voidage", &K::pole_voidage},
      {"pole_reynolds", &K::pole_reynolds},
      {"pole_voidage_square", &K::pole_voidage_square},
      {"pole_reynolds_square", &K::pole_reynolds_square},
      {"pole_voidage_cube", &K::pole_voidage_cube},
      {"crossing", &K::crossing},
  };
  return members;
}

Members<BrinkmanOseenConstants> members_of(const BrinkmanOseenConstants&) {
  using K = BrinkmanOseenConstants;
  static constexpr std::pair<const char*, double K::*> members[] = {
      {"inertia_phi", &K::inertia_phi}, {"stretch", &K::stretch},         {"power", &K::power},
      {"power_phi", &K::power_phi},     {"forchheimer", &K::forchheimer}, {"forchheimer_phi", &K::forchheimer_phi},
      {"screening", &K::screening},
  };
  return members;
}

template <class Published>
DragForm form_of() {
  DragForm form{std::string(Published::name), {}};
  for (const auto& [name, member] : members_of(Published::constants))
    form.constants.push_back({name, Published::constants.*member});
  return form;
}

template <class Law>
DragLaw with_constants(const std::map<std::string, double>& given, Guard guard) {
  Law law;
  law.base.guard = guard;
  auto& constants = law.base.constants;
  const auto members = members_of(constants);
  for (const auto& [name, member] : members) {
    const auto found = given.find(name);
    if (found == given.end()) throw std::invalid_argument(std::string("constant '") + name + "' is missing");
    if (!(found->second > 0 && std::isfinite(found->second)))
      throw std::invalid_argument(std::string("constant '") + name + "' must be above 0");
    constants.*member = found->second;
  }
  if (given.size() > members.size()) throw std::invalid_argument("a constant that the form has not");
  return {law};
}

}  // namespace

std::vector<DragForm> drag_forms() { return {form_of<PublishedCello>(), form_of<PublishedBrinkmanOseen>()}; }

DragLaw fitted_drag_law(std::string_view form, const std::map<std::string, double>& constants, Guard guard) {
  if (form == PublishedCello::name) return with_constants<MixtureFittedCello>(constants, guard);
  if (form == PublishedBrinkmanOseen::name) return with_constants<MixtureFittedBrinkmanOseen>(constants, guard);
  throw std::invalid_argument("unknown form '" + std::string(form) + "'");
}

std::optional<UnusableAt> unusable_at(const DragLaw& law) {
  constexpr int voidages = 91, decades = 7, per_decade = 20;
  for (int i = 0; i < voidages; ++i)
    for (int n = -1; n <= decades * per_decade; ++n) {
      const double eps = 1 - 0.01 * i, re = n < 0 ? 0 : 0.01 * std::pow(10.0, double(n) / per_decade);
      double f = 0, slope = 0;
      GuardCount count;
      drag_of_points(law, {&eps, 1}, {&re, 1}, {&f, 1}, {&slope, 1}, count);
      if (!(f > 0 && std::isfinite(f) && f + slope > 0)) return UnusableAt{eps, re, f};
    }
  return std::nullopt;
}

}  // namespace polybed::closures
