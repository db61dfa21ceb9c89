// Slip of a rarefied gas on small spheres.
#pragma once

#include <fmt/format.h>

#include "closures/relevance.hpp"
#include "core/case/scene.hpp"
#include "core/error.hpp"
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

/// Broken if the fluid is a liquid; another rule covers a fluid without known properties.
inline core::Broken slips_on_a_liquid(const core::Scene& scene) {
  if (!core::is_law(core::law_of(scene, "gas_slip")) || !scene.fluid.present()) return {};
  try {
    const double density = fluid_constants(scene.fluid).density;
    return density > lightest_liquid ? core::Broken({fmt::format("{:.4g}", density)}) : core::Broken();
  } catch (const core::CaseError&) {
    return {};
  }
}

inline const Effect gas_slip{
    .role = "gas_slip",
    .help = "slip of a rarefied gas on small spheres, which lowers their drag",
    .laws = {{"cunningham", "lower by the mean free path over the diameter, at the outlet's pressure",
              "drag over 1 + Kn (1.257 + 0.4 exp(-1.1/Kn)); Davies 1945"}},
    .rules = {needs_a_fluid("gas_slip"),
              {{"effects.gas_slip", "fluid."},
               "effects.gas_slip: a fluid of {} kg/m3 is a liquid, which does not slip: leave it out",
               slips_on_a_liquid}},
    .number = "1.257 Kn",
    .phrase = "the gas slips along small particles: less drag by {} its value",
    .weigh = weigh_gas_slip};

}  // namespace polybed::relevance::effects
