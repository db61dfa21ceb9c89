// The force of past accelerations.
#pragma once

#include "closures/relevance.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/supremum.hpp"

namespace polybed::relevance::effects {

inline std::optional<EffectRow> weigh_history(const Weighing& by, EffectRow row) {
  row = as_force(row, by.scene);
  Supremum greatest;
  for (const Situation& s : by.survey.situations) {
    const double value =
        closures::history_relevance(s.diameter, s.fluid_density, s.viscosity, s.slip, s.time(), s.reference());
    if (s.particle_reynolds() > 1)
      greatest.add_uncertain(s, {closures::history_relevance_least(s.diameter, s.fluid_density, s.viscosity, s.slip,
                                                                   s.time(), s.reference()),
                                 value});
    else
      greatest.add(s, value);
  }
  greatest.fill(row);
  return row;
}

inline const Effect history{
    .role = "history",
    .help = "vorticity that past accelerations of a particle have left in the fluid",
    .absent = "no law of it in the two-fluid model",
    .laws = {{"basset", "of one sphere in creeping flow; adds an inertia", "Basset 1888, summed by exponentials"}},
    .rules = {needs_a_fluid("history"), idle_in_a_sheared_box("history"),
              rule_of("history", {"dem.held"},
                      "effects.history = \"{}\" is a force on particles that accelerate, and dem.held holds them: "
                      "leave one out",
                      [](const core::Scene& scene) { return scene.bed.held; })},
    .number = "Basset force over weight",
    .phrase = "drag that past accelerations leave behind: {} the weight",
    .weigh = weigh_history,
    .idle = [](const Weighing& by) -> std::string {
      return by.scene.bed.held ? "the particles are held (dem.held) and do not accelerate" : "";
    },
    .of_acceleration = true};

}  // namespace polybed::relevance::effects
