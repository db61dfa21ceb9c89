// Keys that have no effect because of other keys.
#include <fmt/format.h>

#include <cmath>

#include "core/case/case_rules.hpp"

namespace polybed::core {

namespace {

using Test = bool (*)(const Scene&);

/// A key that has no effect in some scenes.
struct Idle {
  std::string key, what;  ///< where it is reported, and its name there
  Test set;
};

bool has_inlet(const Scene& scene) {
  return !scene.inlet.superficial_velocity.empty() || !scene.inlet.flow_rate.empty();
}
bool has_jets(const Scene& scene) { return !scene.jets.empty(); }
bool has_discharges(const Scene& scene) { return !scene.discharges.empty(); }
bool has_lid(const Scene& scene) { return scene.column.outlet == Outlet::lid; }
bool is_given_at_the_top(const Scene& scene) { return scene.inlet.at == ColumnEnd::top; }
bool is_compressible(const Scene& scene) { return scene.fluid.compressible(); }

/// One rule for each of them. \param rests_on  keys besides their own
std::vector<Rule> cannot_act(const std::vector<Idle>& idle, Test where, const std::string& why,
                             const std::vector<std::string>& rests_on) {
  std::vector<Rule> rules;
  for (const Idle& one : idle) {
    std::vector<std::string> keys{one.key};
    keys.insert(keys.end(), rests_on.begin(), rests_on.end());
    rules.push_back({std::move(keys), one.what + " cannot act" + why,
                     [set = one.set, where](const Scene& scene) { return broken_if(where(scene) && set(scene)); }});
  }
  return rules;
}

std::vector<Rule> without_a_fluid() {
  return cannot_act(
      {{"inlet.superficial_velocity", "inlet.superficial_velocity", has_inlet},
       {"jet.superficial_velocity", "[[jet]]", has_jets},
       {"inlet.at", "inlet.at = \"top\"", is_given_at_the_top},
       {"column.outlet", "column.outlet = \"lid\", which stops the fluid alone,", has_lid},
       {"column.grading", "column.grading", [](const Scene& s) { return bool(s.column.grading); }},
       {"species.sphericity", "species.sphericity", [](const Scene& s) { return !all_spheres(s); }},
       {"fluid.temperature", "fluid.temperature", [](const Scene& s) { return bool(s.fluid.temperature); }},
       {"fluid.density", "fluid.density", [](const Scene& s) { return bool(s.fluid.density); }},
       {"fluid.viscosity", "fluid.viscosity", [](const Scene& s) { return bool(s.fluid.viscosity); }},
       {"fluid.equation_of_state", "fluid.equation_of_state", is_compressible}},
      [](const Scene& scene) { return !scene.fluid.present(); }, ": fluid.name = \"none\"", {"fluid.name"});
}

std::vector<Rule> in_a_closed_column() {
  return cannot_act(
      {{"inlet.superficial_velocity", "inlet.superficial_velocity", has_inlet},
       {"jet.superficial_velocity", "[[jet]]", has_jets},
       {"inlet.at", "inlet.at = \"top\"", is_given_at_the_top},
       {"feed.species", "[[feed]]", [](const Scene& s) { return !s.feeds.empty(); }},
       {"discharge.at", "[[discharge]]", has_discharges},
       {"column.outlet", "column.outlet = \"open\"", [](const Scene& s) { return s.column.outlet == Outlet::open; }},
       {"column.outlet", "column.outlet = \"lid\"", has_lid}},
      [](const Scene& scene) { return scene.column.closed; }, ": column.closed = true", {"column.closed"});
}

std::vector<Rule> in_a_sheared_box() {
  return cannot_act({{"inlet.superficial_velocity", "inlet.superficial_velocity", has_inlet},
                     {"jet.superficial_velocity", "[[jet]]", has_jets},
                     {"inlet.at", "inlet.at = \"top\"", is_given_at_the_top},
                     {"discharge.at", "[[discharge]]", has_discharges},
                     {"dem.held", "dem.held = true", [](const Scene& s) { return s.bed.held; }},
                     {"fluid.equation_of_state", "fluid.equation_of_state", is_compressible}},
                    [](const Scene& scene) { return scene.column.shear_rate != 0 && scene.fluid.present(); },
                    " in a sheared box: its fluid moves with its flow", {"dem.shear_rate", "fluid.name"});
}

std::vector<Rule> between_joined_ends() {
  return cannot_act({{"inlet.superficial_velocity", "inlet.superficial_velocity", has_inlet},
                     {"jet.superficial_velocity", "[[jet]]", has_jets},
                     {"inlet.at", "inlet.at = \"top\"", is_given_at_the_top}},
                    [](const Scene& scene) { return scene.flows_around(); },
                    " between joined ends: column.pressure_gradient drives the fluid",
                    {"column.ends", "fluid.name", "dem.shear_rate"});
}

/// For keys that give the amount or the initial density. \param random  also without effect in a randomly placed bed
Rule idle_at_start(const std::string& key, bool random, Test set) {
  return {
      {"bed." + key, "bed.start"}, "bed." + key + " cannot act: bed.start = \"{}\"", [set, random](const Scene& scene) {
        const StartKind kind = scene.bed.start.kind;
        const bool idle = kind == StartKind::list || (random && kind == StartKind::random);
        return idle && set(scene) ? Broken({text_of(scene.bed.start)}) : Broken();
      }};
}

std::vector<Rule> beside_the_start() {
  return {idle_at_start("start_solids_fraction", true, [](const Scene& s) { return bool(s.bed.start_fraction); }),
          idle_at_start("volume_share", false, [](const Scene& s) { return !s.bed.volume_share.empty(); }),
          idle_at_start("static_height", false, [](const Scene& s) { return s.bed.static_height > 0; }),
          idle_at_start("particles", false, [](const Scene& s) { return !s.bed.particles.empty(); })};
}

/// Two values from the least to the greatest, or none; of the inversion also one.
template <class Table>
Rule is_rising(const std::string& key, Table Scene::*table, std::vector<double> Table::*list) {
  constexpr bool one = std::is_same_v<Table, Inversion>;
  const std::string number = one ? ": one value, or two" : ": two values";
  return {{key}, key + number + ", the least and the greatest", [=](const Scene& scene) {
            const std::vector<double>& v = scene.*table.*list;
            return broken_if(v.size() > 2 || (v.size() == 2 && v[0] > v[1]) || (v.size() == 1 && !one));
          }};
}

std::vector<Rule> of_a_flow_rate() {
  return {{{"inlet.flow_rate", "inlet.superficial_velocity"},
           "inlet.flow_rate and inlet.superficial_velocity both say how much flows in: give one of them",
           [](const Scene& scene) {
             return broken_if(!scene.inlet.flow_rate.empty() && !scene.inlet.superficial_velocity.empty());
           },
           true},
          {{"inlet.flow_rate", "column.depth", "column.size"},
           "inlet.flow_rate in two dimensions needs column.depth: without it there is no area that it flows through",
           [](const Scene& scene) {
             return broken_if(!scene.inlet.flow_rate.empty() && scene.column.given_size.size() == 2 &&
                              !scene.column.depth && !scene.column.around_axis());
           },
           true},
          {{"inlet.flow_rate", "column.size", "column.depth"},
           "inlet.flow_rate makes {} m/s over the column's cross-section; at most 1000 m/s",
           [](const Scene& scene) {
             for (const auto& [time, velocity] : scene.inlet.superficial_velocity)
               if (std::abs(velocity) > 1e3) return Broken({fmt::format("{:.4g}", velocity)});
             return Broken();
           }}};
}

std::vector<Rule> of_the_fluid() {
  return {
      {{"inlet.superficial_velocity", "inlet.flow_rate", "fluid.name", "column.closed", "column.ends",
        "dem.shear_rate"},
       "inlet.superficial_velocity is missing (or give inlet.flow_rate, or set column.closed = true)",
       [](const Scene& scene) {
         const bool flows = scene.fluid.present() && scene.column.shear_rate == 0 && !scene.flows_around();
         return broken_if(flows && !scene.column.closed && !has_inlet(scene));
       }},
      {{"inlet.at", "column.outlet"},
       "inlet.at = \"top\" and column.outlet = \"open\" contradict each other: what spreads the fluid holds the "
       "solids back",
       [](const Scene& scene) { return broken_if(is_given_at_the_top(scene) && scene.column.outlet == Outlet::open); }},
      {{"inlet.at", "fluid.equation_of_state"},
       "inlet.at = \"top\" and a compressible fluid contradict each other: its pressure is given at the top",
       [](const Scene& scene) { return broken_if(is_given_at_the_top(scene) && is_compressible(scene)); }},
      {{"fluid.equation_of_state", "fluid.name"},
       "fluid.equation_of_state = \"ideal_gas\": water is a liquid; \"tait\" is the law of a compressible liquid",
       [](const Scene& scene) {
         return broken_if(scene.fluid.equation_of_state == Compressibility::ideal_gas &&
                          scene.fluid.substance() == Substance::water);
       }},
      {{"fluid.equation_of_state", "fluid.name"},
       "fluid.equation_of_state = \"tait\": air is a gas; \"ideal_gas\" is its law",
       [](const Scene& scene) {
         return broken_if(scene.fluid.equation_of_state == Compressibility::tait &&
                          scene.fluid.substance() == Substance::air);
       }},
      {{"dem.held", "fluid.name"},
       "dem.held = true is a fixed bed for a fluid to flow through: fluid.name is \"none\"",
       [](const Scene& scene) { return broken_if(scene.bed.held && !scene.fluid.present()); }},
      is_rising("chooser.velocity_range", &Scene::chooser, &Chooser::velocity_range),
      is_rising("chooser.temperature_range", &Scene::chooser, &Chooser::temperature_range),
      is_rising("inversion.measured", &Scene::inversion, &Inversion::measured),
      is_rising("inversion.simulated", &Scene::inversion, &Inversion::simulated)};
}

}  // namespace

std::vector<Rule> idle_rules() {
  std::vector<Rule> rules;
  for (const auto& part : {without_a_fluid(), in_a_closed_column(), in_a_sheared_box(), between_joined_ends(),
                           beside_the_start(), of_a_flow_rate(), of_the_fluid()})
    rules.insert(rules.end(), part.begin(), part.end());
  return rules;
}

}  // namespace polybed::core
