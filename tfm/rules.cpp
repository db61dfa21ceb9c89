#include "tfm/rules.hpp"

#include <fmt/format.h>

#include <variant>

#include "closures/stress_frictional.hpp"
#include "core/case/scene.hpp"
#include "relevance/effects/solids_stress.hpp"
#include "tfm/packing_limit.hpp"

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

/// tfm.max_packing if it is a number, else 0.
double packing_number(const Scene& scene) {
  const double* number = std::get_if<double>(&scene.tfm.max_packing);
  return number == nullptr ? 0 : *number;
}

bool packing_follows(const Scene& scene, core::PackingRule rule) {
  return scene.tfm.max_packing == core::MaxPacking(rule);
}

Broken packing_below_onset(const Scene& scene) {
  const double most = packing_number(scene);
  const bool below = most <= scene.tfm.frictional_onset + closures::FrictionalLaw::margin;
  if (!has_stress(scene) || !(most > 0) || !below) return {};
  return Broken({fmt::format("{}", most), fmt::format("{}", scene.tfm.frictional_onset)});
}

Broken bed_below_onset(const Scene& scene) {
  const double fraction = scene.bed.solids_fraction;
  const bool below = fraction > 0 && fraction <= scene.tfm.frictional_onset;
  if (!has_stress(scene) || !packing_follows(scene, core::PackingRule::automatic) || !below) return {};
  return Broken({fmt::format("{}", fraction), fmt::format("{}", scene.tfm.frictional_onset)});
}

/// A run stops where solids lie above the maximum packing by as much.
Broken start_above_packing(const Scene& scene) {
  const double given = packing_number(scene), start = scene.bed.start_solids_fraction;
  if (!has_stress(scene) || !(given > 0) || start - given <= most_above_packing) return {};
  return Broken({fmt::format("{}", given), fmt::format("{:.4g}", start), fmt::format("{:g}", most_above_packing)});
}

/// The end of a message.
constexpr const char* only_particles = ": polybed dem can run it, polybed tfm cannot";

core::Rule for_particles(std::vector<std::string> keys, const std::string& what, bool (*is_so)(const Scene&)) {
  return {std::move(keys), what + only_particles,
          [is_so](const Scene& scene) { return core::broken_if(is_so(scene)); }};
}

bool leans(const Scene& scene) {
  const auto& down = scene.column.down;
  return down[0] != 0 || down[2] != 0 || !(down[1] < 0);
}

/// Of a column that leans: it needs walls to lean on and a start that does not ask where down is.
core::Rule for_leaning_particles(const std::string& key, const std::string& where, bool (*is_so)(const Scene&)) {
  return {{"column.gravity_direction", key},
          "column.gravity_direction other than down " + where + only_particles,
          [is_so](const Scene& scene) { return core::broken_if(leans(scene) && is_so(scene)); }};
}

}  // namespace

std::vector<core::Rule> key_rules() {
  return {
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
      {{"tfm.max_packing", "tfm.frictional_onset"},
       "tfm.max_packing = {} must lie above tfm.frictional_onset = {}",
       packing_below_onset},
      {{"bed.solids_fraction", "tfm.max_packing", "tfm.frictional_onset"},
       "bed.solids_fraction = {} must lie above tfm.frictional_onset = {} for tfm.max_packing = \"auto\"",
       bed_below_onset},
      {{"tfm.form", "fluid.equation_of_state"},
       "tfm.form = \"B\" is for incompressible fluids: the pressure that follows a gas would not hold up the solids",
       [](const Scene& scene) {
         return core::broken_if(scene.tfm.form == core::PressureForm::B &&
                                scene.fluid.equation_of_state != core::Compressibility::incompressible);
       }},
      {{"tfm.fixed_step", "tfm.integrator"},
       "tfm.fixed_step works with explicit and imex steps only",
       [](const Scene& scene) { return core::broken_if(is_implicit(scene) && scene.tfm.fixed_step); }},
      {{"tfm.rtol", "tfm.integrator"}, "tfm.rtol = {} with the implicit integrator: {}", [](const Scene& scene) {
         const std::string wrong = wrong_with_implicit_tolerance(scene.tfm.rtol);
         return is_implicit(scene) && !wrong.empty() ? Broken({fmt::format("{}", scene.tfm.rtol), wrong}) : Broken();
       }}};
}

std::string wrong_with_implicit_tolerance(double rtol) {
  constexpr double least = 1e-10, most = 2e-3;
  return rtol > most    ? fmt::format("at most {}, beyond which its predictor jumps past packing", most)
         : rtol < least ? fmt::format("at least {}, below which round-off stops its Newton iteration", least)
                        : "";
}

std::vector<core::Rule> start_rules() {
  return {{{"tfm.max_packing", "bed.solids_fraction", "bed.start_solids_fraction", "bed.start"},
           "tfm.max_packing = {}: the bed at its start, with a solids fraction of {}, lies more than {} above; lower "
           "bed.start_solids_fraction",
           start_above_packing}};
}

const std::vector<core::Rule>& model_rules() {
  static const std::vector<core::Rule> all{
      for_particles({"fluid.name"}, "fluid.name = \"none\"", [](const Scene& s) { return !s.fluid.present(); }),
      for_particles({"column.ends"}, "column.ends = \"periodic\"",
                    [](const Scene& s) { return s.column.ends == core::Boundary::periodic; }),
      for_particles({"dem.shear_rate"}, "dem.shear_rate other than 0",
                    [](const Scene& s) { return s.column.shear_rate != 0; }),
      {{"bed.start"},
       std::string("bed.start = \"{}\"") + only_particles,
       [](const Scene& s) {
         const StartKind kind = s.bed.start.kind;
         return kind == StartKind::random || kind == StartKind::list ? Broken({text_of(s.bed.start)}) : Broken();
       }},
      for_leaning_particles("column.closed", "without column.closed = true",
                            [](const Scene& s) { return !s.column.closed; }),
      for_leaning_particles("column.sides", "with column.sides = \"periodic\"",
                            [](const Scene& s) { return s.column.sides == core::Boundary::periodic; }),
      for_leaning_particles("bed.start", "with bed.start = \"settled\"",
                            [](const Scene& s) { return s.bed.start.kind == StartKind::settled; })};
  return all;
}

std::vector<std::string> only_for_particles(const Scene& scene) { return core::faults_of(model_rules(), scene); }

void refuse_particle_scene(const Scene& scene) { core::refuse(model_rules(), scene); }

}  // namespace polybed::tfm
