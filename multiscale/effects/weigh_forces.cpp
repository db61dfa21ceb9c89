#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "closures/gas_slip.hpp"
#include "closures/relevance.hpp"
#include "closures/terminal_velocity.hpp"
#include "fluid/gas_slip.hpp"
#include "multiscale/effects/supremum.hpp"
#include "multiscale/effects/weigh.hpp"

namespace polybed::multiscale {

namespace {

using State = EffectRow::State;

constexpr double room_temperature = 293.15;  ///< K, where the case names none

EffectRow force_row(const char* effect, const char* model, const char* number, double tolerance) {
  EffectRow row = effect_row(effect, model, number);
  row.threshold = tolerance;
  row.summed = true;
  row.on_particles = true;
  return row;
}

/// The greatest that a run may reach of a sheared particle: every slip up to the greatest, where the law is told, under
/// the shear of a cell. It is a scale, too wide to choose by.
template <class Relevance>
double greatest_of_run(const Situation& s, const Survey& survey, Relevance&& of_slip) {
  if (!(survey.cell > 0)) return 0;
  Situation met = s;
  met.slip = std::max(s.slip, survey.greatest_packed_slip);
  met.shear = std::max(s.shear, closures::shear_rate_of_cell(met.slip, survey.clump_acceleration, survey.cell));
  const double told = std::min(1.0, greatest_certain_reynolds / met.particle_reynolds());
  double value = 0;
  for (int n = 1; n <= 33; ++n) value = std::max(value, of_slip(met, met.slip * told * n / 33));
  return value;
}

/// A force as a share of the reference, whose law is trusted up to a Reynolds number of the slip.
/// \param of_slip  by the scales of the choice  \param in_run  by those of a run
template <class Relevance, class InRun>
EffectRow weigh_sheared(EffectRow row, const Survey& survey, Relevance&& of_slip, InRun&& in_run) {
  Supremum greatest;
  for (const Situation& s : survey.situations) {
    // The share of the lift falls with the slip: its greatest lies within the range, from a fifth of it.
    double value = 0;
    for (int n = 0; n < 33; ++n) {
      const double share = 0.2 + 0.8 * n / 32, found = of_slip(s, s.slip * share);
      value = std::max(value, found);
      // Where the fastest are beyond the law's range, slower ones of the same zone are within it, under its shear.
      if (share * s.particle_reynolds() <= greatest_certain_reynolds)
        row.up_to = std::max(row.up_to.value_or(0), found);
    }
    row.up_to = std::max(row.up_to.value_or(0), greatest_of_run(s, survey, in_run));
    if (s.particle_reynolds() > greatest_certain_reynolds)
      greatest.add_uncertain(s, {0, value});
    else
      greatest.add(s, value);
  }
  greatest.fill(row);
  return row;
}

EffectRow added_mass(const core::Scene& scene, const Survey& survey) {
  EffectRow row = force_row("added_mass", "zuber", "C_m s/(1 + C_m s)", scene.chooser.tolerance);
  row.models = "dem";
  Supremum greatest;
  double ratio = 0;
  for (const Situation& s : survey.situations) {
    const double density_ratio = s.fluid_density / s.density;
    ratio = std::max(ratio, density_ratio);
    greatest.add(s, closures::added_mass_relevance(closures::added_mass_zuber(1 - s.voidage), density_ratio));
  }
  greatest.fill(row);
  if (ratio >= 1) {
    row.state = State::on;
    row.reason = fmt::format("always with a fluid as dense as the particles or denser (s = {:.3g})", ratio);
  }
  return row;
}

EffectRow history(const core::Scene& scene, const Survey& survey) {
  EffectRow row = force_row("history", "basset", "Basset force over weight", scene.chooser.tolerance);
  row.models = "dem";
  Supremum greatest;
  for (const Situation& s : survey.situations) {
    const double value =
        closures::history_relevance(s.diameter, s.fluid_density, s.viscosity, s.slip, s.time(), s.reference());
    if (s.particle_reynolds() > 1)
      greatest.add_uncertain(s, {closures::history_relevance_least(s.diameter, s.fluid_density, s.viscosity, s.slip,
                                                                   s.time(), s.reference()),
                                 value});
    else
      greatest.add(s, value);
  }
  greatest.fill(row);
  return row;
}

EffectRow lift(const core::Scene& scene, const Survey& survey) {
  EffectRow row = force_row("lift", "saffman_mei", "lift over weight", scene.chooser.tolerance);
  row.models = "dem";
  const auto force = [](const Situation& s, double slip) {
    return closures::lift_relevance(s.diameter, s.fluid_density, s.viscosity, slip, s.shear, s.reference());
  };
  return weigh_sheared(row, survey, force, force);
}

EffectRow magnus(const core::Scene& scene, const Survey& survey) {
  EffectRow row = force_row("magnus", "rubinow_keller", "Magnus force over weight", scene.chooser.tolerance);
  row.models = "dem";
  const auto force = [](const Situation& s, double slip, double spin) {
    return closures::magnus_relevance(s.diameter, s.fluid_density, s.viscosity, slip, spin, s.reference());
  };
  return weigh_sheared(
      row, survey, [&](const Situation& s, double slip) { return force(s, slip, 0.5 * s.shear); },
      [&](const Situation& s, double slip) {  // touching at speeds up to the slip, which lets particles spin
        return force(s, slip, 0.5 * s.shear + closures::spin_of_impact(s.slip, s.diameter));
      });
}

EffectRow brownian(const core::Scene& scene, const Survey& survey) {
  EffectRow row = force_row("brownian", "langevin", "1/Pe", scene.chooser.tolerance);
  row.models = "dem";
  if (!scene.fluid.temperature) row.not_built = "needs fluid.temperature; weighed at 20 degC";
  if (scene.dem.held) row.not_built = "dem.held holds the particles";
  Supremum greatest;
  for (const Situation& s : survey.situations) {
    const double terminal =
        closures::settling_velocity(s.diameter, s.density - s.fluid_density, s.fluid_density, s.viscosity, s.gravity);
    const double falling = terminal > 0 ? terminal : s.slip;
    const double temperature = s.temperature > 0 ? s.temperature : room_temperature;
    greatest.add(s, closures::brownian_relevance(temperature, s.viscosity, s.diameter, falling));
  }
  greatest.fill(row);
  return row;
}

EffectRow gas_slip(const core::Scene& scene, const Survey& survey) {
  EffectRow row = force_row("gas_slip", "cunningham", "1.257 Kn", scene.chooser.tolerance);
  row.summed = false;  // it changes the drag, whose error is told apart
  if (!survey.is_gas) {
    row.neglected = 0;
    row.reason = "a liquid does not slip";
    return row;
  }
  Supremum greatest;
  for (const Situation& s : survey.situations)
    greatest.add(s,
                 closures::gas_slip_relevance(
                     fluid::mean_free_path_at(scene.fluid.outlet_pressure, s.fluid_density, s.viscosity), s.diameter));
  greatest.fill(row);
  return row;
}

EffectRow lubrication(const core::Scene& scene, const Survey& survey) {
  EffectRow row = force_row("lubrication", "wet_restitution", "least St*", 35 / scene.chooser.tolerance);
  row.models = "dem";
  row.summed = false;
  row.below = true;
  double most = 0;
  for (const Situation& s : survey.situations) {
    const auto stokes = [&](double speed) {
      return closures::stokes_of_impact(s.density, s.fluid_density, s.diameter, speed, s.viscosity);
    };
    const double least = stokes(0.2 * s.slip);
    most = std::max(most, stokes(s.slip));
    if (!row.value || least < *row.value) {
      row.value = least;
      row.where = s.species + ", " + s.zone;
    }
    auto& zone = row.zones.try_emplace(s.zone, least).first->second;
    zone = std::min(zone, least);
  }
  row.number = fmt::format("least St* (greatest {:.2g})", most);
  return row;
}

EffectRow cohesion(const core::Scene& scene, const Survey& survey) {
  const Surfaces surfaces = surfaces_of(scene, survey);
  EffectRow row = force_row("cohesion", "van_der_waals", "pull of rough surfaces over weight", scene.chooser.tolerance);
  row.models = "dem";
  Supremum greatest;
  const auto pull = [&](double reference) {
    return closures::van_der_waals_relevance(surfaces.hamaker, surfaces.roughness, reference);
  };
  for (const Situation& s : survey.touching()) greatest.add(s, pull(s.reference()));
  greatest.fill(row);
  return row;
}

}  // namespace

Surfaces surfaces_of(const core::Scene& scene, const Survey& survey) {
  const double known = scene.dem.hamaker_constant, usual = survey.is_gas || !survey.has_fluid ? 1e-19 : 1e-20;
  return {scene.chooser.roughness.value_or(scene.dem.roughness),
          scene.chooser.hamaker.value_or(known > 0 ? known : usual)};
}

std::vector<EffectRow> weigh_forces(const core::Scene& scene, const Survey& survey) {
  return {added_mass(scene, survey), history(scene, survey),  lift(scene, survey),        magnus(scene, survey),
          brownian(scene, survey),   gas_slip(scene, survey), lubrication(scene, survey), cohesion(scene, survey)};
}

}  // namespace polybed::multiscale
