// Viscous stress of the averaged fluid.
#pragma once

#include <algorithm>

#include "closures/relevance.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/supremum.hpp"

namespace polybed::relevance::effects {

/// Distance over which the fluid's velocity changes by the slip, m: min(L/10, 10 d), as in the shear next to a wall.
[[nodiscard]] inline double shear_length(const Situation& s) { return std::min(0.1 * s.width, 10 * s.diameter); }

inline std::optional<EffectRow> weigh_fluid_stress(const Weighing& by, EffectRow row) {
  row.threshold = by.scene.chooser.tolerance;
  Supremum greatest;
  for (const Situation& s : by.survey.situations)
    if (s.zone != Zone::freeboard)
      greatest.add(s, closures::fluid_stress_relevance(s.viscosity, s.exchange(), shear_length(s)));
  greatest.fill(row);
  if (row.value) row.share_off = std::min(*row.value, 1.0);
  return row;
}

inline const Effect fluid_stress{
    .role = "fluid_stress",
    .help = "viscous stress of the averaged fluid",
    .laws = {{"newtonian", "of a Newtonian fluid", "mu (grad U + grad U^T - 2/3 div U I); Cello 2009, eq. 1.16"}},
    .rules = {needs_a_fluid("fluid_stress"), idle_in_a_sheared_box("fluid_stress")},
    .number = "share of a shear length, 2 sqrt(mu/beta)/min(L/10, 10 d)",
    .phrase = "the fluid's viscosity reaches across {} the distance over which the flow is sheared",
    .weigh = weigh_fluid_stress};

}  // namespace polybed::relevance::effects
