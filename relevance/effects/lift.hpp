// Lift of spheres in a sheared fluid.
#pragma once

#include "closures/lift_saffman_mei.hpp"
#include "closures/relevance.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/effects/sheared.hpp"

namespace polybed::relevance::effects {

inline std::optional<EffectRow> weigh_lift(const Weighing& by, EffectRow row) {
  const auto force = [](const Situation& s, double slip) {
    return closures::lift_relevance(s.diameter, s.fluid_density, s.viscosity, slip, s.shear, s.reference());
  };
  return weigh_sheared(as_force(row, by.scene), by.survey, force, force);
}

inline std::optional<double> share_of_lift(const Encountered& met) {
  if (!met.certain()) return std::nullopt;
  return share_of(closures::lift_saffman_mei(met.slip, met.vorticity, met.diameter, met.fluid_density, met.viscosity),
                  met.weight);
}

inline const Effect lift{.role = "lift",
                         .help = "force across a sheared fluid's stream",
                         .laws = {{"saffman_mei", "of one sphere", "Saffman 1965 with the share of Mei 1992"}},
                         .rules = {needs_a_fluid("lift"), idle_in_a_sheared_box("lift")},
                         .number = "lift over weight",
                         .phrase = "side force of the sheared fluid: {} the weight",
                         .weigh = weigh_lift,
                         .share = share_of_lift};

}  // namespace polybed::relevance::effects
