// Fluid that particles drag along.
#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "closures/added_mass.hpp"
#include "closures/relevance.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/supremum.hpp"

namespace polybed::relevance::effects {

inline std::optional<EffectRow> weigh_added_mass(const Weighing& by, EffectRow row) {
  row = as_force(row, by.scene);
  Supremum greatest;
  double ratio = 0;
  for (const Situation& s : by.survey.situations) {
    const double density_ratio = s.fluid_density / s.density;
    ratio = std::max(ratio, density_ratio);
    greatest.add(s, closures::added_mass_relevance(closures::added_mass_zuber(1 - s.voidage), density_ratio));
  }
  greatest.fill(row);
  if (ratio >= 1) {
    row.state = EffectRow::State::on;
    row.reason = fmt::format("the fluid is as dense as the particles or denser, {:.3g} times: always on", ratio);
  }
  return row;
}

inline const Effect added_mass{
    .role = "added_mass",
    .help = "fluid that a particle drags along when it accelerates",
    .laws = {{"zuber", "of a sphere among others", "C_m = (1 + 2 phi)/(2 (1 - phi)), Zuber 1964"},
             {"half", "of one sphere: half the mass of the fluid that it displaces", "C_m = 1/2; Lamb 1932"}},
    .rules = {needs_a_fluid("added_mass"), idle_in_a_sheared_box("added_mass")},
    .number = "C_m s/(1 + C_m s)",
    .phrase = "fluid that speeds up with the particles: {} the mass in motion",
    .weigh = weigh_added_mass,
    .of_acceleration = true};

}  // namespace polybed::relevance::effects
