// Fluctuations that the kinetic stress rests on.
#pragma once

#include <algorithm>

#include "closures/relevance.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"

namespace polybed::relevance::effects {

inline std::optional<EffectRow> weigh_granular_temperature(const Weighing& by, EffectRow row) {
  row.threshold = by.scene.chooser.tolerance;
  const EffectRow* stress = find_row(by.rows, "solids_stress");
  if (stress == nullptr || stress->model != "kinetic") {
    row.neglected = 0;
    row.reason = "acts only with kinetic solids_stress";
    return row;
  }
  row.state = EffectRow::State::on;
  double longest = 0;
  for (const core::Species& s : by.scene.species)
    longest = std::max(longest, closures::conduction_length(s.diameter, std::min(by.survey.solids_fraction, 0.6),
                                                            std::min(s.restitution, 0.999)));
  row.value = longest / by.survey.height;
  if (*row.value > *row.threshold) row.model = "transported";
  row.reason = row.model == "transported" ? "conducted further than collisions let it stay" : "local balance is enough";
  return row;
}

inline const Effect granular_temperature{
    .role = "granular_temperature",
    .help = "fluctuations that the kinetic stress rests on",
    .absent = "particles have velocities of their own",
    .laws = {{"algebraic", "production, collisions and drag in balance; the default with solids_stress = kinetic"},
             {"transported", "one equation for each species"}},
    .rules = joined({{rule_of("granular_temperature", {"effects.solids_stress"},
                              "effects.granular_temperature = \"{}\" acts only with solids_stress = \"kinetic\" or a "
                              "dry table",
                              [](const core::Scene& scene) { return core::law_of(scene, "solids_stress") == "none"; })},
                     excludes("granular_temperature", "*", "solids_stress", "frictional",
                              "fluctuations act through the kinetic stress alone")}),
    .number = "conduction length over height",
    .weigh = weigh_granular_temperature};

}  // namespace polybed::relevance::effects
