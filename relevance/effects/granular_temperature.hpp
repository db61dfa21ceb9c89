// Velocity fluctuations, on which the kinetic stress is based.
#pragma once

#include <algorithm>

#include "closures/relevance.hpp"
#include "core/case/scene.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/effects/solids_stress.hpp"

namespace polybed::relevance::effects {

inline std::optional<EffectRow> weigh_granular_temperature(const Weighing& by, EffectRow row) {
  row.threshold = by.scene.chooser.tolerance;
  const EffectRow* stress = find_row(by.rows, "solids_stress");
  const std::string given = core::law_of(by.scene, "solids_stress");
  const std::string law = given == core::automatic && stress != nullptr ? stress->model : given;
  if (!solids_stress.law_has(law, kinetic_theory)) {
    row.neglected = 0;
    row.reason = "acts with solids_stress = \"kinetic\" alone";
    return row;
  }
  row.state = EffectRow::State::on;
  double longest = 0;
  for (const core::Species& s : by.scene.species)
    longest = std::max(longest, closures::conduction_length(s.diameter, std::min(by.survey.solids_fraction, 0.6),
                                                            std::min(s.restitution, 0.999)));
  row.value = longest / by.survey.height;
  const bool far = *row.value > *row.threshold;
  if (far) row.model = "transported";
  row.reason = far ? "fluctuations spread further than they last: an equation for each species"
                   : "fluctuations end where they arise: a balance in each cell is enough";
  return row;
}

inline constexpr Trait transported{"an equation for each species"};
[[nodiscard]] inline bool is_transported(const core::Scene& scene);

/// Names of the species without losses in collisions: their temperature has no bound in a local balance.
inline core::Broken elastic_species(const core::Scene& scene) {
  if (!solids_stress.has(scene, kinetic_theory) || is_transported(scene)) return {};
  std::string names;
  for (const core::Species& species : scene.species)
    if (species.restitution >= 1) names += (names.empty() ? "\"" : ", \"") + species.name + "\"";
  return names.empty() ? core::Broken() : core::Broken({names});
}

inline const Effect granular_temperature{
    .role = "granular_temperature",
    .help = "velocity fluctuations of particles, which the kinetic stress depends on",
    .absent = "particles have velocities of their own",
    .laws = {{"algebraic", "in balance in each cell; the default with solids_stress = kinetic",
              "production, collisions and drag in balance, by the theory of solids_stress = kinetic"},
             {"transported", "one equation for each species",
              "Lun, Savage, Jeffrey and Chepurniy 1984, or Garzo and Dufty 1999"}},
    .rules =
        joined({{{{"effects.solids_stress", "effects.granular_temperature", "species.restitution", "dem.restitution"},
                  "effects.granular_temperature = \"algebraic\" needs a restitution below 1: species {}",
                  elastic_species},
                 rule_of("granular_temperature", {"effects.solids_stress"},
                         "effects.granular_temperature = \"{}\" acts only with solids_stress = \"kinetic\" or a "
                         "dry table",
                         [](const core::Scene& scene) { return !core::acts(scene, "solids_stress"); })},
                excludes("granular_temperature", any_law, "solids_stress", "frictional",
                         "fluctuations act through the kinetic stress alone")}),
    .number = "conduction length over height",
    .weigh = weigh_granular_temperature,
    .traits = {{&transported, {"transported"}}}};

inline bool is_transported(const core::Scene& scene) { return granular_temperature.has(scene, transported); }

}  // namespace polybed::relevance::effects
