#include "relevance/effect_rules.hpp"

#include <fmt/format.h>

#include "core/case/scene.hpp"
#include "core/error.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::relevance {

namespace {

using core::Broken;
using core::Rule;
using core::Scene;

std::string key_of(const std::string& role) { return "effects." + role; }

std::vector<std::string> keys_of(const std::string& role, const std::vector<std::string>& rests_on) {
  std::vector<std::string> keys{key_of(role)};
  keys.insert(keys.end(), rests_on.begin(), rests_on.end());
  return keys;
}

}  // namespace

Rule rule_of(const std::string& role, const std::vector<std::string>& rests_on, const std::string& message,
             std::function<bool(const Scene&)> wrong) {
  return {keys_of(role, rests_on), message, [=, wrong = std::move(wrong)](const Scene& scene) {
            const std::string law = core::law_of(scene, role);
            return core::is_law(law) && wrong(scene) ? Broken({law}) : Broken();
          }};
}

Rule rule_of_law(const std::string& role, const std::string& law, const std::vector<std::string>& rests_on,
                 const std::string& message, std::function<bool(const Scene&)> wrong) {
  return {keys_of(role, rests_on), message, [=, wrong = std::move(wrong)](const Scene& scene) {
            return core::broken_if(core::law_of(scene, role) == law && wrong(scene));
          }};
}

Rule needs_a_fluid(const std::string& role) {
  return rule_of(role, {"fluid.name"}, key_of(role) + " = \"{}\" cannot act: fluid.name = \"none\"",
                 [](const Scene& scene) { return !scene.fluid.present(); });
}

Rule refuses_a_liquid(const std::string& role, const std::string& why) {
  return {keys_of(role, {"fluid."}), key_of(role) + ": a fluid of {} kg/m3 is a liquid, " + why + ": leave it out",
          [role](const Scene& scene) -> Broken {
            if (!core::is_law(core::law_of(scene, role)) || !scene.fluid.present()) return {};
            try {
              const double density = fluid_constants(scene.fluid).density;
              return density > lightest_liquid ? Broken({fmt::format("{:.4g}", density)}) : Broken();
            } catch (const core::CaseError&) {
              return {};
            }
          }};
}

Rule idle_in_a_sheared_box(const std::string& role) {
  return {
      keys_of(role, {"dem.shear_rate", "fluid.name"}),
      key_of(role) + " cannot act in a sheared box: its fluid moves with its flow", [role](const Scene& scene) {
        return core::broken_if(scene.column.shear_rate != 0 && scene.fluid.present() && scene.effects.contains(role));
      }};
}

std::vector<Rule> excludes(const std::string& role, const std::optional<std::string>& law, const std::string& other,
                           const std::string& other_law, const std::string& why) {
  const auto both = [=](const Scene& scene) {
    const std::string one = core::law_of(scene, role);
    return (law ? one == *law : core::is_law(one)) && core::law_of(scene, other) == other_law;
  };
  const std::string at = key_of(role), against = key_of(other);
  return {{{at, against},
           at + " = \"{}\" cannot be with " + against + " = \"" + other_law + "\": " + why,
           [=](const Scene& scene) { return both(scene) ? Broken({core::law_of(scene, role)}) : Broken(); }},
          {{against, at},
           against + " = \"" + other_law + "\" cannot be with " + at + " = \"{}\"",
           [=](const Scene& scene) { return both(scene) ? Broken({core::law_of(scene, role)}) : Broken(); }}};
}

std::vector<Rule> joined(std::initializer_list<std::vector<Rule>> lists) {
  std::vector<Rule> all;
  for (const std::vector<Rule>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace polybed::relevance
