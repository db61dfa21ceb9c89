// Attraction between particles in or near contact.
#pragma once

#include "closures/relevance.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/supremum.hpp"

namespace polybed::relevance::effects {

inline std::optional<EffectRow> weigh_cohesion(const Weighing& by, EffectRow row) {
  const Surfaces surfaces = surfaces_of(by.scene, by.survey);
  row = as_force(row, by.scene);
  row.model = "van_der_waals";
  Supremum greatest;
  for (const Situation& s : by.survey.touching())
    greatest.add(s, closures::van_der_waals_relevance(surfaces.hamaker, surfaces.roughness, s.reference()));
  greatest.fill(row);
  constexpr double powder = 10;  // pull over weight above which drag laws of ordinary beds do not apply
  if (row.value.value_or(0) > powder) row.remark = "so cohesive a powder is outside the validated range";
  return row;
}

inline void set_cohesion_keys(core::Scene& scene, const Surfaces& surfaces) {
  scene.material.hamaker_constant = surfaces.hamaker;
  scene.dem.cohesion_gap = closures::relevance_contact_gap;
  scene.dem.asperity_radius = 0.5 * surfaces.roughness;
}

inline const Effect cohesion{
    .role = "cohesion",
    .help = "attraction of particles that touch or nearly do",
    .absent = "part of the solids stress in the two-fluid model",
    .laws = {{"dmt", "constant pull in contact: hard small spheres, dem.cohesion_energy",
              "2 pi W R*; Derjaguin, Muller and Toporov 1975"},
             {"jkr", "pull that enlarges the contact: soft large spheres, dem.cohesion_energy",
              "Johnson, Kendall and Roberts 1971, in place of Hertz"},
             {"van_der_waals", "pull across a gap, dem.hamaker_constant, dem.cohesion_gap",
              "A R*/(6 z^2); Hamaker 1937"}},
    .rules = joined({{rule_of_law("cohesion", "van_der_waals", {"dem.hamaker_constant"},
                                  "dem.hamaker_constant: effects.cohesion = \"van_der_waals\" needs it, as in 1e-19",
                                  [](const core::Scene& scene) { return !(scene.material.hamaker_constant > 0); })},
                     excludes("cohesion", "jkr", "contact", "linear",
                              "it stands in place of Hertz' force, which linear springs have not")}),
    .number = "pull of rough surfaces over weight",
    .phrase = "attraction of surfaces that touch: {} the weight",
    .weigh = weigh_cohesion,
    .share = [](const Encountered& met) -> std::optional<double> {
      return closures::van_der_waals_relevance(met.surfaces.hamaker, met.surfaces.roughness, met.weight);
    },
    .set_keys = set_cohesion_keys};

}  // namespace polybed::relevance::effects
