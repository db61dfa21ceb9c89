// Slip of a rarefied gas on small spheres.
#pragma once

#include "closures/relevance.hpp"
#include "core/case/scene.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/fluid_properties.hpp"
#include "relevance/supremum.hpp"

namespace polybed::relevance::effects {

inline std::optional<EffectRow> weigh_gas_slip(const Weighing& by, EffectRow row) {
  row = as_force(row, by.scene);
  row.summed = false;  // it modifies the drag: see share_off
  if (!by.survey.is_gas) {
    row.neglected = 0;
    row.reason = "a liquid does not slip";
    return row;
  }
  Supremum greatest;
  for (const Situation& s : by.survey.situations)
    greatest.add(s, closures::gas_slip_relevance(
                        mean_free_path_at(by.scene.fluid.outlet_pressure, s.fluid_density, s.viscosity), s.diameter));
  greatest.fill(row);
  row.share_off = row.value;
  return row;
}

inline const Effect gas_slip{
    .role = "gas_slip",
    .help = "slip of a rarefied gas on small spheres, which lowers their drag",
    .laws = {{"cunningham", "lower by the mean free path over the diameter, at the outlet's pressure",
              "drag over 1 + Kn (1.257 + 0.4 exp(-1.1/Kn)); Davies 1945"}},
    .rules = {needs_a_fluid("gas_slip"), refuses_a_liquid("gas_slip", "which does not slip")},
    .number = "1.257 Kn",
    .phrase = "the gas slips along small particles: less drag by {} its value",
    .weigh = weigh_gas_slip};

}  // namespace polybed::relevance::effects
