// Lubrication by fluid that approaching particles squeeze out.
#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "closures/relevance.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"

namespace polybed::relevance::effects {

inline std::optional<EffectRow> weigh_lubrication(const Weighing& by, EffectRow row) {
  row = as_force(row, by.scene);
  row.threshold = 35 / by.scene.chooser.tolerance;
  row.summed = false;
  row.below = true;
  double most = 0;
  for (const Situation& s : by.survey.situations) {
    const auto stokes = [&](double speed) {
      return closures::stokes_of_impact(s.density, s.fluid_density, s.diameter, speed, s.viscosity);
    };
    const double least = stokes(0.2 * s.slip);
    most = std::max(most, stokes(s.slip));
    if (!row.value || least < *row.value) {
      row.value = least;
      row.where = s.species + ", " + name_of(s.zone);
    }
    auto& zone = row.zones.try_emplace(name_of(s.zone), least).first->second;
    zone = std::min(zone, least);
  }
  row.number = fmt::format("least St* (greatest {:.2g})", most);
  return row;
}

inline constexpr Trait of_unresolved_flow{"stands for the flow between particles"};

inline const Effect lubrication{.role = "lubrication",
                                .help = "fluid that is squeezed out between particles that meet",
                                .absent = "part of the solids stress in the two-fluid model",
                                .laws = {{"wet_restitution", "lower restitution, by the speed at first touch",
                                          "restitution times exp(-35/St*), Legendre et al. 2005"},
                                         {"film", "force of the film, down to a gap of dem.roughness",
                                          "6 pi mu R*^2 v_n/h from a gap h of 0.1 R*"}},
                                .rules = {needs_a_fluid("lubrication")},
                                .number = "least St*",
                                .phrase = "the fluid between particles damps impacts: Stokes number {}",
                                .weigh = weigh_lubrication,
                                .traits = {{&of_unresolved_flow, {"wet_restitution"}}}};

}  // namespace polybed::relevance::effects
