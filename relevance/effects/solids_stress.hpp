// Pressure of packed or colliding solids.
#pragma once

#include <algorithm>

#include "relevance/effect.hpp"

namespace polybed::relevance::effects {

/// Shear rate times relaxation time for the species with the most damping; fills in the row's place and zones.
inline std::optional<double> inertia_of_shear(const Weighing& by, EffectRow& row) {
  std::optional<double> least;
  for (const core::Species& species : by.scene.species) {
    std::optional<double> most;
    for (const Situation& s : by.survey.situations)
      if (s.species == species.name && s.zone != Zone::freeboard && 1 - s.voidage > 1e-2) {
        const double value = s.shear * s.relaxation_time();
        most = std::max(most.value_or(0), value);
        auto& zone = row.zones.try_emplace(name_of(s.zone), value).first->second;
        zone = std::max(zone, value);
      }
    if (most && (!least || *most < *least)) {
      least = most;
      row.where = species.name;
    }
  }
  return least;
}

inline std::optional<EffectRow> weigh_solids_stress(const Weighing& by, EffectRow row) {
  if (!by.survey.has_fluid) {
    row.neglected = 0;
    row.reason = without_a_fluid;
    return row;
  }
  row.state = EffectRow::State::on;  // without it the model is ill-posed
  row.threshold = 1;
  if (by.survey.solids_fraction > 0.5) row.share_off = 1;  // it carries a packed bed; friction acts from there
  row.value = inertia_of_shear(by, row);
  if (!row.value) {
    row.reason = "too dilute to shear as a bed; friction acts above a solids fraction of 0.5";
  } else if (*row.value >= 1) {
    row.model = "kinetic";
    row.reason = "the fluid hardly damps collisions: kinetic theory holds";
  } else {
    row.reason = "the fluid damps collisions: take a table of polybed calibrate, else friction alone";
  }
  return row;
}

inline constexpr Trait kinetic_theory{"collisions as kinetic theory has them, with a granular temperature"};
inline constexpr Trait with_collisions{"collisions add to it, or may: a table may be of either kind"};

inline const Effect solids_stress{
    .role = "solids_stress",
    .help = "pressure of the solids, packed or in collision",
    .absent = "particles have contacts instead",
    .laws = {{"frictional", "friction of dense solids", "Johnson and Jackson 1987, with bulk viscosity"},
             {"kinetic", "frictional, and pressure and viscosity by the kinetic theory of collisions",
              "Lun, Savage, Jeffrey and Chepurniy 1984, or Garzo and Dufty 1999"},
             {"table:FILE", "frictional, and what polybed calibrate measured",
              "of a fluidised bed, or of sheared particles"}},
    .advice = {{"frictional", "liquid bed"},
               {"kinetic", "bubbling gas bed, whose particles collide freely"},
               {"table:FILE", "bed whose fluid damps collisions, after polybed calibrate"}},
    .number = "shear rate x tau_p",
    .weigh = weigh_solids_stress,
    .traits = {{&kinetic_theory, {"kinetic"}}, {&with_collisions, {"kinetic", "table:FILE"}}}};

}  // namespace polybed::relevance::effects
