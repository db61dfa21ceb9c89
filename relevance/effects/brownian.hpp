// Brownian motion of small spheres.
#pragma once

#include "closures/relevance.hpp"
#include "closures/terminal_velocity.hpp"
#include "core/case/scene.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/supremum.hpp"

namespace polybed::relevance::effects {

inline std::optional<EffectRow> weigh_brownian(const Weighing& by, EffectRow row) {
  constexpr double room_temperature = 293.15;  // K, if the case gives none
  row = as_force(row, by.scene);
  if (!by.scene.fluid.temperature) row.not_built = "needs fluid.temperature; weighed at 20 degC";
  if (by.scene.bed.held) row.not_built = "dem.held holds the particles";
  Supremum greatest;
  for (const Situation& s : by.survey.situations) {
    const double terminal =
        closures::settling_velocity(s.diameter, s.density - s.fluid_density, s.fluid_density, s.viscosity, s.gravity);
    const double falling = terminal > 0 ? terminal : s.slip;
    const double temperature = s.temperature > 0 ? s.temperature : room_temperature;
    greatest.add(s, closures::brownian_relevance(temperature, s.viscosity, s.diameter, falling));
  }
  greatest.fill(row);
  return row;
}

inline const Effect brownian{
    .role = "brownian",
    .help = "heat motion of small particles, with fluid.temperature",
    .absent = "no law of it in the two-fluid model",
    .laws = {{"langevin", "random force in balance with the drag",
              "variance 2 k_B T k/dt, k the drag over the slip; Langevin 1908"}},
    .rules = {needs_a_fluid("brownian"),
              rule_of("brownian", {"fluid.name", "fluid.temperature"},
                      "fluid.temperature: effects.brownian = \"{}\" needs it, as in \"20 degC\"",
                      [](const core::Scene& scene) { return scene.fluid.present() && !scene.fluid.temperature; }),
              rule_of("brownian", {"effects.drag", "dem.held"},
                      "effects.brownian = \"{}\" moves particles against their drag: name a law of effects.drag, and "
                      "leave out dem.held",
                      [](const core::Scene& scene) { return scene.bed.held || !scene.drag().acts(); })},
    .number = "1/Pe",
    .phrase = "random motion by heat: {} the settling of a particle",
    .weigh = weigh_brownian};

}  // namespace polybed::relevance::effects
