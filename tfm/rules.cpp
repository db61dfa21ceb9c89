#include "tfm/rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

#include "core/case/scene.hpp"
#include "core/case/size_classes.hpp"
#include "core/numerics/blocks.hpp"
#include "fluid/inlet.hpp"
#include "relevance/effects/solids_stress.hpp"
#include "tfm/tolerances.hpp"

namespace polybed::tfm {

namespace {

using core::Broken;
using core::Scene;
using core::StartKind;

bool is_implicit(const Scene& scene) { return scene.tfm.integrator == core::TfmIntegrator::implicit_steps; }

bool has_stress(const Scene& scene) { return core::acts(scene, "solids_stress"); }

Broken wall_without_viscosity(const Scene& scene) {
  const bool left_open = core::law_of(scene, "solids_stress") == core::automatic;
  return core::broken_if(scene.tfm.solids_wall == core::SolidsWall::johnson_jackson &&
                         !core::acts(scene, "solids_viscosity") && !left_open &&
                         !relevance::effects::solids_stress.has(scene, relevance::effects::with_collisions));
}

/// Walls inside the column that cut the cells.
Broken solids_held_by_inner_walls(const Scene& scene) {
  if (scene.walls.empty() || scene.tfm.solids_wall == core::SolidsWall::free_slip) return {};
  return Broken({std::string(core::name_of(scene.tfm.solids_wall))});
}

/// Walls that stop the solids' motion must follow the grid, as they do around an axis.
Broken solids_held_by_a_round_wall(const Scene& scene) {
  const core::ColumnShape shape = scene.column.shape;
  const core::SolidsWall wall = scene.tfm.solids_wall;
  const bool follows = scene.column.around_axis() && !scene.column.is_tapered() && wall == core::SolidsWall::no_slip;
  if (shape == core::ColumnShape::box || wall == core::SolidsWall::free_slip || follows) return {};
  return Broken({std::string(core::name_of(shape)), std::string(core::name_of(wall))});
}

bool packing_follows(const Scene& scene, core::PackingRule rule) {
  return scene.tfm.max_packing == core::MaxPacking(rule);
}

/// The end of a message.
constexpr const char* only_particles = ": polybed dem can run it, polybed tfm cannot";

core::Rule for_particles(std::vector<std::string> keys, const std::string& what, bool (*is_so)(const Scene&)) {
  return {std::move(keys), what + only_particles,
          [is_so](const Scene& scene) { return core::broken_if(is_so(scene)); }};
}

/// Species that are fed on every face of the top, so that none can leave through it.
Broken outlet_fed_shut(const Scene& scene) {
  Broken broken;
  if (scene.column.outlet != core::Outlet::open || scene.column.closed || scene.feeds.empty()) return broken;
  const core::Grid grid = core::grid_of(scene, nullptr);
  std::map<std::string, std::vector<double>> fed;  // on each face, by species
  for (std::size_t n = 0; n < scene.feeds.size(); ++n) {
    const core::Feed& feed = scene.feeds[n];
    if (feed.at != core::ColumnFace::top) continue;
    const std::vector<double> share = fluid::face_shares(grid, feed.from, feed.to, feed.at);
    std::vector<double>& sum = fed.try_emplace(feed.species, share.size(), 0.0).first->second;
    const bool was_shut = std::find(sum.begin(), sum.end(), 0.0) == sum.end();
    std::transform(sum.begin(), sum.end(), share.begin(), sum.begin(), std::plus());
    if (!was_shut && std::find(sum.begin(), sum.end(), 0.0) == sum.end())
      broken.add({feed.species}, core::entry_of(scene, scene.feeds, n));
  }
  return broken;
}

/// Feeds, jets and discharges with no flow, since a round wall cuts off all their cells.
Broken on_closed_cells(const Scene& scene) {
  Broken broken;
  if ((!scene.column.is_round() && !scene.column.is_tapered()) || scene.column.closed) return broken;
  const core::Grid grid = core::grid_of(scene.column, nullptr);
  const auto see = [&](const auto& parts, const char* what) {
    for (std::size_t n = 0; n < parts.size(); ++n) {
      const std::vector<double> share = fluid::face_shares(grid, parts[n].from, parts[n].to, parts[n].at);
      if (std::all_of(share.begin(), share.end(), [](double one) { return one == 0; }))
        broken.add({what, std::to_string(n + 1)});
    }
  };
  see(scene.feeds, "[[feed]]");
  see(scene.jets, "[[jet]]");
  see(scene.discharges, "[[discharge]]");
  return broken;
}

/// A discharge and a feed through one face of a cell, where the solids have only one velocity.
Broken discharge_beside_a_feed(const Scene& scene) {
  Broken broken;
  const core::Grid grid = core::grid_of(scene.column, nullptr);
  const auto shares = [&](const auto& part) { return fluid::face_shares(grid, part.from, part.to, part.at); };
  for (std::size_t n = 0; n < scene.discharges.size(); ++n)
    for (std::size_t k = 0; k < scene.feeds.size(); ++k) {
      if (scene.discharges[n].at != scene.feeds[k].at) continue;
      const std::vector<double> out = shares(scene.discharges[n]), in = shares(scene.feeds[k]);
      bool meet = false;
      for (std::size_t f = 0; f < out.size(); ++f) meet = meet || (out[f] > 0 && in[f] > 0);
      if (meet)
        broken.add({std::to_string(n + 1), std::to_string(1 + *core::entry_of(scene, scene.feeds, k)),
                    std::string(core::name_of(scene.feeds[k].at))},
                   n);
    }
  return broken;
}

bool leans(const Scene& scene) {
  const auto& down = scene.column.down;
  return down[0] != 0 || down[2] != 0 || !(down[1] < 0);
}

/// For a tilted column: it needs walls that support the solids and a start that does not depend on the vertical.
core::Rule for_leaning_particles(const std::string& key, const std::string& where, bool (*is_so)(const Scene&)) {
  return {{"column.gravity_direction", key},
          "column.gravity_direction other than down " + where + only_particles,
          [is_so](const Scene& scene) { return core::broken_if(leans(scene) && is_so(scene)); }};
}

}  // namespace

std::vector<core::Rule> key_rules() {
  std::vector<core::Rule> rules{
      {{"tfm.solids_wall", "effects.solids_viscosity", "effects.solids_stress"},
       "tfm.solids_wall = \"johnson_jackson\" acts through a viscosity of the solids: effects.solids_viscosity, or "
       "effects.solids_stress = \"kinetic\"",
       wall_without_viscosity},
      {{"tfm.max_packing", "species.diameter"},
       "tfm.max_packing = \"fedors_landel\" is for two species; yu_standish is for any number",
       [](const Scene& scene) {
         return core::broken_if(has_stress(scene) && packing_follows(scene, core::PackingRule::fedors_landel) &&
                                scene.species.size() != 2);
       }},
      {{"tfm.form", "fluid.equation_of_state"},
       "tfm.form = \"B\" is for incompressible fluids: the pressure that follows a gas would not hold up the solids",
       [](const Scene& scene) {
         return core::broken_if(scene.tfm.form == core::PressureForm::B &&
                                scene.fluid.equation_of_state != core::Compressibility::incompressible);
       }},
      {{"feed.from", "feed.to", "feed.at", "feed.species", "column.", "species.name", "species.diameter", "dem.skin"},
       "[[feed]] of {} takes every cell of the top, where none of it can leave then though column.outlet = \"open\": "
       "give "
       "feed.from and feed.to for a part of the top, or column.outlet = \"screen\"",
       outlet_fed_shut},
      {{"column.shape", "column.size", "column.cells", "feed.", "jet.", "discharge."},
       "{} number {} lies on cells that the round wall cuts off: move it inwards, or take smaller cells",
       on_closed_cells},
      {{"discharge.from", "discharge.", "feed.", "column.", "species.name", "species.diameter", "dem.skin"},
       "[[discharge]] number {} and [[feed]] number {} share a cell ({}): move them apart, or take smaller "
       "cells",
       discharge_beside_a_feed},
      {{"column.shape", "column.profile", "tfm.solids_wall"},
       "column.shape = \"{}\" and tfm.solids_wall = \"{}\" cannot be combined yet: the solids slip freely along round "
       "walls",
       solids_held_by_a_round_wall},
      {{"column.grading_across", "effects.solids_stress"},
       "column.grading_across and collisions of solids in effects.solids_stress cannot be combined yet: use "
       "\"frictional\"",
       [](const Scene& scene) {
         return core::broken_if(scene.column.grading_across &&
                                relevance::effects::solids_stress.has(scene, relevance::effects::with_collisions));
       }},
      {{"wall.shape", "wall.thickness", "tfm.solids_wall"},
       "[[wall]] and tfm.solids_wall = \"{}\" cannot be combined yet: the solids slip freely along walls inside",
       solids_held_by_inner_walls},
      {{"tfm.fixed_step", "tfm.integrator"},
       "tfm.fixed_step works with explicit and imex steps only",
       [](const Scene& scene) { return core::broken_if(is_implicit(scene) && scene.tfm.fixed_step); }}};
  const std::vector<core::Rule> of_stress = stress_rules();
  rules.insert(rules.end(), of_stress.begin(), of_stress.end());
  return rules;
}

std::string wrong_with_implicit_tolerance(double rtol) {
  constexpr double least = least_implicit_tolerance, most = 2e-3;
  return rtol > most    ? fmt::format("at most {}, beyond which its predictor jumps past packing", most)
         : rtol < least ? fmt::format("at least {}, below which round-off stops its Newton iteration", least)
                        : "";
}

const std::vector<core::Rule>& model_rules() {
  static const std::vector<core::Rule> all{
      for_particles({"fluid.name"}, "fluid.name = \"none\"", [](const Scene& s) { return !s.fluid.present(); }),
      for_particles({"dem.shear_rate"}, "dem.shear_rate other than 0",
                    [](const Scene& s) { return s.column.shear_rate != 0; }),
      {{"bed.start"},
       std::string("bed.start = \"{}\"") + only_particles,
       [](const Scene& s) {
         const StartKind kind = s.bed.start.kind;
         const bool counted = kind == StartKind::checkpoint && !(s.bed.solids_fraction > 0);  // made by particles alone
         return kind == StartKind::random || kind == StartKind::list || counted ? Broken({text_of(s.bed.start)})
                                                                                : Broken();
       }},
      for_leaning_particles("column.shape", "in a round column",
                            [](const Scene& s) { return s.column.shape != core::ColumnShape::box; }),
      for_leaning_particles("column.closed", "without column.closed = true or inlet.at = \"top\"",
                            [](const Scene& s) { return !s.column.closed && s.inlet.at == core::ColumnEnd::bottom; }),
      for_leaning_particles("column.sides", "with column.sides = \"periodic\"",
                            [](const Scene& s) { return s.column.sides == core::Boundary::periodic; }),
      for_leaning_particles("bed.start", "with bed.start = \"settled\"",
                            [](const Scene& s) { return s.bed.start.kind == StartKind::settled; })};
  return all;
}

const Scene& continuum_scene(const Scene& scene) {
  core::refuse(model_rules(), scene);
  return scene;
}

}  // namespace polybed::tfm
