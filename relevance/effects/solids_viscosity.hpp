// Resistance of packed solids to shear.
#pragma once

#include "core/case/scene.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"

namespace polybed::relevance::effects {

inline constexpr Trait by_inertial_number{"its friction goes with the inertial number"};

inline const Effect solids_viscosity{
    .role = "solids_viscosity",
    .help = "resistance of packed solids to shear",
    .absent = "particles have contacts instead",
    .laws = {{"schaeffer", "friction in proportion to the pressure",
              "p_f sin(delta)/abs(gamma), capped; Schaeffer 1987"},
             {"mu_i", "friction that grows with the shear rate; dry grains",
              "mu(I) p_f/abs(gamma), capped; Jop, Forterre and Pouliquen 2006"}},
    .rules = {rule_of("solids_viscosity", {"effects.solids_stress"},
                      "effects.solids_viscosity = \"{}\" needs a solids_stress: its pressure",
                      [](const core::Scene& scene) { return !core::acts(scene, "solids_stress"); })},
    .number = no_number,
    .weigh = [](const Weighing&, EffectRow row) -> std::optional<EffectRow> {
      row.reason = "your choice: no number decides it";
      return row;
    },
    .traits = {{&by_inertial_number, {"mu_i"}}}};

}  // namespace polybed::relevance::effects
