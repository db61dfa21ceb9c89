// Liquid bridges between wet particles in a gas.
#pragma once

#include <numbers>

#include "closures/relevance.hpp"
#include "core/case/scene.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/supremum.hpp"

namespace polybed::relevance::effects {

inline std::optional<EffectRow> weigh_liquid_bridge(const Weighing& by, EffectRow row) {
  row = as_force(row, by.scene);
  const core::Material& liquid = by.scene.material;
  const std::optional<double> tension = liquid.surface_tension;
  row.neglected = 0;
  if (by.survey.has_fluid && !by.survey.is_gas) {
    row.reason = "immersed particles have no liquid bridges";
    return row;
  }
  if (!tension) {
    row.reason = "dry: dem.surface_tension names no liquid";
    return row;
  }
  if (!(liquid.liquid_fraction > 0)) row.not_built = "needs dem.liquid_fraction, how much liquid there is";
  const double angle = liquid.contact_angle * std::numbers::pi / 180;
  Supremum greatest;
  for (const Situation& s : by.survey.touching())
    greatest.add(s, closures::capillary_relevance(*tension, angle, s.diameter, s.reference()));
  row.neglected.reset();
  greatest.fill(row);
  return row;
}

inline const Effect liquid_bridge{
    .role = "liquid_bridge",
    .help = "pull of liquid between wet particles in a gas",
    .absent = "no law of it in the two-fluid model",
    .laws = {{"willett",
              "pendular bridges that form at contact and rupture apart: dem.surface_tension, dem.liquid_fraction",
              "2 pi R gamma cos(theta)/(1 + 1.05 s + 2.5 s^2), s = gap sqrt(R/V); Willett et al. 2000"}},
    .rules = {refuses_a_liquid("liquid_bridge", "in which particles have no liquid bridges"),
              rule_of("liquid_bridge", {"dem.surface_tension"},
                      "dem.surface_tension: effects.liquid_bridge = \"{}\" needs it, as in \"72 mN/m\"",
                      [](const core::Scene& scene) { return !scene.material.surface_tension; }),
              rule_of("liquid_bridge", {"dem.liquid_fraction"},
                      "dem.liquid_fraction: effects.liquid_bridge = \"{}\" needs it, above 0, as in 0.01",
                      [](const core::Scene& scene) { return !(scene.material.liquid_fraction > 0); })},
    .number = "pull of a bridge over weight (Bond number)",
    .phrase = "pull of liquid between particles: {} the weight",
    .weigh = weigh_liquid_bridge};

}  // namespace polybed::relevance::effects
