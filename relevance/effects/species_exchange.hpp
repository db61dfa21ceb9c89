// Momentum that solid species exchange by contact.
#pragma once

#include <algorithm>
#include <cmath>

#include "closures/relevance.hpp"
#include "closures/species_exchange_syamlal.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"

namespace polybed::relevance::effects {

inline std::optional<EffectRow> weigh_species_exchange(const Weighing& by, EffectRow row) {
  const core::Scene& scene = by.scene;
  const Survey& survey = by.survey;
  row.threshold = scene.chooser.tolerance;
  const std::size_t n = scene.species.size();
  if (n < 2 || !survey.has_fluid) {
    row.neglected = 0;
    row.reason = n < 2 ? "one species: nothing to exchange" : without_a_fluid;
    return row;
  }
  const double eps = survey.voidage_of_difference, phi = 1 - eps;
  double surface = 0, greatest = 0;
  for (std::size_t j = 0; j < n; ++j) surface += survey.share[j] * phi / scene.species[j].diameter;
  for (const Situation& s : survey.situations) {
    if (s.zone != Zone::bulk || std::abs(s.voidage - eps) > 1e-9) continue;
    const auto own = std::find_if(scene.species.begin(), scene.species.end(),
                                  [&](const core::Species& species) { return species.name == s.species; });
    for (std::size_t k = 0; k < n; ++k) {
      const core::Species& other = scene.species[k];
      if (other.name == s.species) continue;
      const closures::SpeciesPair pair{s.diameter,
                                       other.diameter,
                                       s.density,
                                       other.density,
                                       0.5 * (own->restitution + other.restitution),
                                       0.5 * (own->friction + other.friction)};
      const double speed = survey.greatest_slip_difference;
      const double exchange =
          closures::species_exchange(pair, closures::radial_distribution(pair, eps, surface), speed, 0);
      const double value = closures::species_exchange_relevance(exchange, survey.share[k] * phi, speed,
                                                                s.exchange() / (1 - s.voidage), s.slip);
      if (value > greatest) {
        greatest = value;
        row.where = s.species + " by " + other.name + ", bulk";
      }
    }
  }
  row.value = greatest;
  row.share_off = greatest;
  return row;
}

inline const Effect species_exchange{
    .role = "species_exchange",
    .help = "momentum that solid species exchange by contact",
    .absent = "particles have contacts instead",
    .laws = {{"syamlal", "collisions, and contact in a packed bed", "Syamlal 1987; Gera 2004"},
             {"table:FILE", "collisions as polybed calibrate measured them in dry boxes"}},
    .number = "contact of species over drag",
    .phrase = "contacts between the species: {} the drag",
    .weigh = weigh_species_exchange};

}  // namespace polybed::relevance::effects
