#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "closures/relevance.hpp"
#include "multiscale/effects/supremum.hpp"
#include "multiscale/effects/weigh.hpp"

namespace polybed::multiscale {

namespace {

using State = EffectRow::State;

EffectRow phase_row(const char* effect, const char* model, const char* models, const char* number) {
  EffectRow row = effect_row(effect, model, number);
  row.models = models;
  return row;
}

EffectRow drag(const core::Scene& scene, const Survey& survey) {
  EffectRow row = phase_row("drag", survey.drag_law.c_str(), "tfm, dem", "mixture part, max |f_j/f_mean - 1|");
  row.state = State::on;
  row.value = survey.mixture_part;
  row.threshold = scene.chooser.tolerance;
  row.reason = survey.mixture_part > scene.chooser.tolerance ? "always on; a law with a mixture part"
                                                             : "always on; its mixture part hardly matters";
  return row;
}

EffectRow fluid_stress(const core::Scene& scene, const Survey& survey) {
  EffectRow row = phase_row("fluid_stress", "newtonian", "tfm, dem", "share of the width, 2 sqrt(mu/beta)/L");
  row.threshold = scene.chooser.tolerance;
  Supremum greatest;
  for (const Situation& s : survey.situations)
    if (s.zone != "freeboard") greatest.add(s, closures::fluid_stress_relevance(s.viscosity, s.exchange(), s.width));
  greatest.fill(row);
  return row;
}

/// Shear rate times relaxation time, of the species that the fluid damps most.
std::optional<double> inertia_of_shear(const core::Scene& scene, const Survey& survey, EffectRow& row) {
  std::optional<double> least;
  for (const core::Species& species : scene.species) {
    std::optional<double> most;
    for (const Situation& s : survey.situations)
      if (s.species == species.name && s.zone != "freeboard" && 1 - s.voidage > 1e-2) {
        const double value = s.shear * s.relaxation_time();
        most = std::max(most.value_or(0), value);
        auto& zone = row.zones.try_emplace(s.zone, value).first->second;
        zone = std::max(zone, value);
      }
    if (most && (!least || *most < *least)) {
      least = most;
      row.where = species.name;
    }
  }
  return least;
}

EffectRow solids_stress(const core::Scene& scene, const Survey& survey) {
  EffectRow row = phase_row("solids_stress", "frictional", "tfm", "shear rate x tau_p");
  row.state = State::on;  // without any the model is ill-posed
  row.threshold = 1;
  row.value = inertia_of_shear(scene, survey, row);
  if (!row.value) {
    row.reason = "too dilute to shear as a bed; friction acts from solids fraction 0.5";
  } else if (*row.value >= 1) {
    row.model = "kinetic";
    row.reason = "collisions are hardly damped: kinetic theory holds";
  } else {
    row.reason =
        "the fluid damps collisions: kinetic theory does not hold; a table of polybed calibrate, else friction";
  }
  return row;
}

EffectRow granular_temperature(const core::Scene& scene, const Survey& survey, const EffectRow& stress) {
  EffectRow row = phase_row("granular_temperature", "algebraic", "tfm", "conduction length over height");
  row.threshold = scene.chooser.tolerance;
  if (stress.model != "kinetic") {
    row.neglected = 0;
    row.reason = "acts only with kinetic solids_stress";
    return row;
  }
  row.state = State::on;
  double longest = 0;
  for (const core::Species& s : scene.species)
    longest = std::max(longest, closures::conduction_length(s.diameter, std::min(survey.solids_fraction, 0.6),
                                                            std::min(scene.dem.restitution, 0.999)));
  row.value = longest / survey.height;
  if (*row.value > *row.threshold) row.model = "transported";
  row.reason = row.model == "transported" ? "conducted further than collisions let it stay" : "local balance is enough";
  return row;
}

EffectRow solids_viscosity() {
  EffectRow row = phase_row("solids_viscosity", "schaeffer", "tfm", "-");
  row.reason = "by hand: no number decides it";
  return row;
}

EffectRow species_exchange(const core::Scene& scene, const Survey& survey) {
  EffectRow row = phase_row("species_exchange", "syamlal", "tfm", "contact of species over drag");
  row.threshold = scene.chooser.tolerance;
  const std::size_t n = scene.species.size();
  if (n < 2 || !survey.has_fluid) {
    row.neglected = 0;
    row.reason = n < 2 ? "one species" : "no fluid: particles only";
    return row;
  }
  const double eps = survey.voidage_of_difference, phi = 1 - eps;
  double surface = 0, greatest = 0;
  for (std::size_t j = 0; j < n; ++j) surface += survey.share[j] * phi / scene.species[j].diameter;
  for (const Situation& s : survey.situations) {
    if (s.zone != "bulk" || std::abs(s.voidage - eps) > 1e-9) continue;
    for (std::size_t k = 0; k < n; ++k) {
      const core::Species& other = scene.species[k];
      if (other.name == s.species) continue;
      const closures::SpeciesPair pair{s.diameter,    other.diameter,        s.density,
                                       other.density, scene.dem.restitution, scene.dem.friction};
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
  return row;
}

EffectRow contact(const core::Scene& scene, const Survey& survey) {
  EffectRow row = phase_row("contact", "hertz_mindlin", "dem", "solids fraction");
  const bool walls = scene.column.sides == core::Boundary::wall || scene.column.ends == core::Boundary::wall;
  row.value = std::max(survey.mean_fraction, survey.solids_fraction);
  row.threshold = 1e-3;
  row.state = State::on;  // the particle model has no other way to keep particles apart
  double friction = scene.dem.friction;
  for (const core::Species& s : scene.species) friction = std::max(friction, s.friction.value_or(0));
  for (const core::ContactPair& p : scene.contact_pairs) friction = std::max(friction, p.friction.value_or(0));
  const bool rubs = friction > 0 && (*row.value > 0.3 || scene.column.sides == core::Boundary::wall);
  if (!rubs) row.model = "hertz";
  row.reason = fmt::format("{}; {}", *row.value > 1e-3 ? "particles meet" : (walls ? "walls" : "never left out"),
                           rubs ? "friction: dense, or sheared by walls" : "no friction: neither dense nor sheared");
  return row;
}

EffectRow rolling(const core::Scene& scene) {
  EffectRow row = phase_row("rolling", "epsd", "dem", "chooser.static_heap");
  row.state = scene.chooser.static_heap ? State::on : State::off;
  row.reason = scene.chooser.static_heap ? "a heap at rest: a spring of rotation, dem.rolling_friction"
                                         : "no heap at rest is asked for";
  if (!scene.chooser.static_heap) row.neglected = 0;
  return row;
}

}  // namespace

std::vector<EffectRow> weigh_phases(const core::Scene& scene, const Survey& survey) {
  std::vector<EffectRow> rows;
  if (survey.has_fluid) rows.push_back(drag(scene, survey));
  rows.push_back(fluid_stress(scene, survey));
  rows.push_back(solids_stress(scene, survey));
  rows.push_back(granular_temperature(scene, survey, rows.back()));
  rows.push_back(solids_viscosity());
  rows.push_back(species_exchange(scene, survey));
  rows.push_back(contact(scene, survey));
  rows.push_back(rolling(scene));
  return rows;
}

}  // namespace polybed::multiscale
