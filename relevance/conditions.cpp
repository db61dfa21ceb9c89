#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "closures/relevance.hpp"
#include "closures/terminal_velocity.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/effect.hpp"
#include "relevance/supremum.hpp"

namespace polybed::relevance {

namespace {

using State = EffectRow::State;
using Kind = EffectRow::Kind;

EffectRow always(const char* effect, const char* reason) {
  EffectRow row = effect_row(effect, "exact", no_number, Kind::condition);
  row.state = State::on;
  row.reason = reason;
  return row;
}

double greatest_slip(const Survey& survey) {
  double slip = 0;
  for (const Situation& s : survey.situations) slip = std::max(slip, s.slip);
  return slip;
}

/// Speed of sound in water at 20 degC, m/s; other liquids differ by at most a third.
constexpr double sound_in_liquids = 1480;

EffectRow equation_of_state(const core::Scene& scene, const Survey& survey) {
  EffectRow row =
      effect_row("equation_of_state", survey.is_gas ? "ideal_gas" : "tait",
                 survey.is_gas ? "greatest of Ma^2/2, dp/p0, rho g H/p0" : "greatest of Ma^2/2, dp/(rho c^2), g H/c^2",
                 Kind::condition);
  row.threshold = scene.chooser.tolerance;
  const double rho = survey.fluid_density, p0 = scene.fluid.outlet_pressure, g = scene.column.gravity;
  double solids = 0;
  for (std::size_t j = 0; j < scene.species.size(); ++j) solids += survey.share[j] * scene.species[j].density;
  const double drop = survey.solids_fraction * survey.height * std::abs(solids - rho) * g;
  const double sound2 = survey.is_gas ? p0 / rho : sound_in_liquids * sound_in_liquids;
  const double mach2 = greatest_slip(survey) * greatest_slip(survey) / sound2;
  row.value = std::max({0.5 * mach2, drop / (rho * sound2), rho * g * survey.column_height / (rho * sound2)});
  const bool calls = *row.value > *row.threshold, set = scene.fluid.compressible();
  row.state = set ? State::on : State::off;
  if (!set) row.neglected = *row.value;
  row.reason = calls == set ? (set ? "fluid.equation_of_state is set" : "density hardly changes")
               : calls      ? "called for: set fluid.equation_of_state = \"" + row.model + "\""
                            : "set, though density hardly changes";
  return row;
}

EffectRow coupling(const Survey& survey) {
  EffectRow row = effect_row("coupling", "four-way", "solids fraction over the column", Kind::condition);
  row.state = State::on;
  row.value = survey.mean_fraction;
  row.threshold = 1e-3;
  const bool few = *row.value < 1e-6, apart = *row.value < 1e-3;
  row.model = few ? "one-way" : (apart ? "two-way" : "four-way");
  row.reason = few     ? "so few particles hardly move the fluid; a run counts that all the same"
               : apart ? "particles hardly meet; a run counts their contacts all the same"
                       : "the fluid moves the particles, they move the fluid and each other";
  return row;
}

EffectRow walls(const core::Scene& scene, const Survey& survey) {
  EffectRow row = effect_row("walls", core::name_of(scene.column.sides).data(), "L/d of the coarsest", Kind::condition);
  double coarsest = 0;
  for (const core::Species& s : scene.species) coarsest = std::max(coarsest, s.diameter);
  row.value = survey.width / coarsest;
  row.threshold = 50;
  row.below = true;
  row.state = scene.column.sides == core::Boundary::wall ? State::on : State::off;
  row.reason = *row.value < 50 ? "narrow: walls order and slow the bed, and results depend on the width"
                               : "wide enough for walls to be local";
  if (scene.column.sides != core::Boundary::wall) row.reason = "periodic: there are none";
  return row;
}

EffectRow level(const Survey& survey) {
  EffectRow row = effect_row("level", "two momenta", "tau_p over the time of flow H/w", Kind::condition);
  row.state = State::on;
  row.threshold = 0.02;
  Supremum greatest;
  for (const Situation& s : survey.situations)
    if (s.zone != Zone::freeboard) greatest.add(s, s.relaxation_time() * s.slip / survey.height);
  greatest.fill(row);
  row.reason = row.value && *row.value < 0.02
                   ? "particles follow the fluid at once; a run computes their momentum all the same"
                   : "particles lag behind the fluid: each has a momentum of its own";
  return row;
}

EffectRow turbulence(const Survey& survey) {
  EffectRow row = effect_row("turbulence", "none", "Re of the column, freeboard", Kind::unmodelled);
  row.threshold = 2000;
  row.value = survey.fluid_density * survey.greatest_velocity * survey.width / survey.viscosity;
  row.reason = *row.value > 2000 ? "not modelled: the flow above the bed is turbulent" : "laminar above the bed";
  return row;
}

EffectRow clusters(const core::Scene& scene, const Survey& survey) {
  EffectRow row = effect_row("clusters", "none", "g Delta/u_t^2 of the finest, cells > 10 d", Kind::unmodelled);
  row.threshold = 0.5;
  double cell = 0;
  for (int axis = 0; axis < scene.column.dimensions; ++axis)
    cell = std::max(cell, scene.column.cell(std::size_t(axis)));
  double value = 0;
  for (const core::Species& s : scene.species) {
    const double terminal =
        closures::settling_velocity(s.diameter, s.density - survey.fluid_density, survey.fluid_density,
                                    survey.viscosity, scene.column.gravity, shape_of(scene, s));
    if (cell > 10 * s.diameter && terminal > 0)
      value = std::max(value, scene.column.gravity * cell / (terminal * terminal));
  }
  row.value = value;
  row.reason = value > 0.5 ? "not modelled: clusters smaller than a cell lower the drag; use finer cells"
                           : "cells resolve what would cluster";
  return row;
}

}  // namespace

std::vector<EffectRow> weigh_conditions(const core::Scene& scene, const Survey& survey) {
  std::vector<EffectRow> rows{always("weight", "always on")};
  if (survey.has_fluid) {
    rows.push_back(always("pressure_gradient", "always on"));
    rows.push_back(equation_of_state(scene, survey));
    rows.push_back(coupling(survey));
  }
  rows.push_back(walls(scene, survey));
  if (survey.has_fluid) {
    rows.push_back(level(survey));
    rows.push_back(turbulence(survey));
    rows.push_back(clusters(scene, survey));
  }
  return rows;
}

}  // namespace polybed::relevance
