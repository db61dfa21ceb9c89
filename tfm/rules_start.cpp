// Requirements of the maximum packing, stress tables, the initial bed and the integrator on a scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "closures/stress_frictional.hpp"
#include "core/case/layers.hpp"
#include "core/error.hpp"
#include "fluid/inlet.hpp"
#include "relevance/fluid_properties.hpp"
#include "tfm/effects/table_file.hpp"
#include "tfm/max_packing.hpp"
#include "tfm/packing_limit.hpp"
#include "tfm/rules.hpp"

namespace polybed::tfm {

namespace {

using core::Broken;
using core::Scene;

bool is_pressed(const Scene& scene) { return core::acts(scene, "solids_stress"); }

/// kg/m3; nothing if it is unknown, which another rule reports.
std::optional<double> density_of_fluid(const Scene& scene) {
  if (!scene.fluid.present()) return {};
  try {
    return relevance::fluid_constants(scene.fluid).density;
  } catch (const core::CaseError&) {
    return {};
  }
}

bool has_shares(const Scene& scene) {
  return !scene.species.empty() && scene.bed.volume_share.size() == scene.species.size();
}

bool has_rule(const Scene& scene, core::PackingRule rule) { return scene.tfm.max_packing == core::MaxPacking(rule); }

/// phi_max for shares of the species, if it can be computed.
std::optional<double> packing_of(const Scene& scene, const std::vector<double>& share) {
  const bool wrong_pair = has_rule(scene, core::PackingRule::fedors_landel) && scene.species.size() != 2;
  const std::optional<double> density = density_of_fluid(scene);
  if (!is_pressed(scene) || !has_shares(scene) || wrong_pair || !density) return {};
  return max_packing_of(scene, share, *density);
}

/// tfm.max_packing as in the case; for a mixture rule also its result.
std::string packing_text(const Scene& scene, double packing) {
  const auto* rule = std::get_if<core::PackingRule>(&scene.tfm.max_packing);
  return rule == nullptr ? fmt::format("{}", packing)
                         : fmt::format("\"{}\" ({:.4g} here)", core::name_of(*rule), packing);
}

bool is_below_onset(const Scene& scene, double packing) {
  return packing <= scene.tfm.frictional_onset + closures::FrictionalLaw::margin;
}

Broken packing_below_onset(const Scene& scene) {
  const std::optional<double> most = packing_of(scene, scene.bed.volume_share);
  if (!most || has_rule(scene, core::PackingRule::automatic) || !is_below_onset(scene, *most)) return {};
  return Broken({packing_text(scene, *most), fmt::format("{}", scene.tfm.frictional_onset)});
}

Broken bed_below_onset(const Scene& scene) {
  const double fraction = core::loosest_settled(scene);
  const std::optional<double> most = packing_of(scene, scene.bed.volume_share);
  if (!most || !has_rule(scene, core::PackingRule::automatic) || !(fraction > 0)) return {};
  if (fraction > scene.tfm.frictional_onset && !is_below_onset(scene, *most)) return {};
  return Broken({fmt::format("{}", fraction), fmt::format("{}", scene.tfm.frictional_onset)});
}

Broken bed_too_light(const Scene& scene) {
  if (!has_rule(scene, core::PackingRule::automatic) || bed_below_onset(scene)) return {};
  const std::optional<double> most = packing_of(scene, scene.bed.volume_share);
  return core::broken_if(most && scene.bed.solids_fraction > 0 && !(*most < 1));
}

/// A run stops if solids exceed the maximum packing by this much.
Broken start_above_packing(const Scene& scene) {
  const bool held_at_settled = has_rule(scene, core::PackingRule::automatic) && scene.layers.empty();
  if (held_at_settled || !has_shares(scene)) return {};
  for (const core::BedPart& part : core::start_parts(scene)) {
    std::vector<double> share = part.solids;
    const double sum = part.all_solids(), start = part.solids_fraction;
    if (!(sum > 0)) continue;
    for (double& one : share) one /= sum;
    if (const std::optional<double> most = packing_of(scene, share); most && start - *most > most_above_packing)
      return Broken(
          {packing_text(scene, *most), fmt::format("{:.4g}", start), fmt::format("{:g}", most_above_packing)});
  }
  return {};
}

Broken settled_without_stress(const Scene& scene) {
  return core::broken_if(scene.bed.start.kind == core::StartKind::settled && !is_pressed(scene));
}

Broken settled_and_light(const Scene& scene) {
  const std::optional<double> fluid = density_of_fluid(scene);
  if (scene.bed.start.kind != core::StartKind::settled || !has_shares(scene) || !fluid) return {};
  double excess = 0;
  for (std::size_t j = 0; j < scene.species.size(); ++j)
    excess += scene.bed.volume_share[j] * (scene.species[j].density - *fluid);
  return core::broken_if(!(excess > 0));
}

Broken split_without_drag(const Scene& scene) {
  const bool split = scene.tfm.integrator == core::TfmIntegrator::split_steps;
  if (!split || (!scene.fluid.compressible() && scene.drag().acts())) return {};
  return Broken({scene.fluid.compressible() ? "an incompressible fluid" : "a drag law"});
}

/// Whether steps are implicit by the case, or certainly by "auto".
bool steps_are_implicit(const Scene& scene) {
  if (scene.tfm.integrator != core::TfmIntegrator::automatic)
    return scene.tfm.integrator == core::TfmIntegrator::implicit_steps;
  const std::optional<double> density = density_of_fluid(scene);
  double inflow = fluid::Ramp(scene.inlet.superficial_velocity).greatest();
  for (const core::Jet& jet : scene.jets) inflow = std::max(inflow, fluid::Ramp(jet.superficial_velocity).greatest());
  for (const core::Feed& feed : scene.feeds)
    if (feed.at != core::ColumnFace::top) inflow = std::max(inflow, fluid::Ramp(feed.superficial_velocity).greatest());
  for (const core::Discharge& discharge : scene.discharges)
    inflow = std::max(inflow, fluid::Ramp(discharge.superficial_velocity).greatest());
  return scene.fluid.compressible() || (density && *density < relevance::lightest_liquid) || scene.column.closed ||
         scene.flows_around() || inflow == 0;
}

Broken implicit_tolerance(const Scene& scene) {
  const std::string wrong = wrong_with_implicit_tolerance(scene.tfm.rtol);
  return steps_are_implicit(scene) && !wrong.empty() ? Broken({fmt::format("{}", scene.tfm.rtol), wrong}) : Broken();
}

/// A rule for a role with a table: reports the problem of the table in this scene.
core::Rule table_rule(const std::string& role, std::string (*wrong)(const Scene&, const std::string& file)) {
  return {{"effects." + role, "effects.solids_stress", "effects.granular_temperature", "effects.solids_viscosity",
           "effects.drag", "tfm.solids_wall", "species.", "bed.", "fluid.", "column.", "calibrate.regime",
           "inlet.superficial_velocity"},
          "effects." + role + ": {}",
          [role, wrong](const Scene& scene) {
            const auto file = table_file(core::law_of(scene, role));
            const std::string problem = file ? wrong(scene, *file) : "";
            return problem.empty() ? Broken() : Broken({problem});
          }};
}

/// Keys that determine the maximum packing.
std::vector<std::string> packing_keys(std::vector<std::string> first) {
  for (const char* key : {"bed.volume_share", "bed.static_height", "bed.particles", "species.diameter",
                          "species.density", "species.max_packing", "fluid.", "column."})
    first.emplace_back(key);
  return first;
}

}  // namespace

std::vector<core::Rule> stress_rules() {
  return {
      {packing_keys({"tfm.max_packing", "tfm.frictional_onset"}),
       "tfm.max_packing = {} must lie above tfm.frictional_onset = {}", packing_below_onset},
      {packing_keys({"bed.solids_fraction", "layer.solids_fraction", "tfm.max_packing", "tfm.frictional_onset"}),
       "solids_fraction = {} of the settled bed, or of a layer, must lie above tfm.frictional_onset = {} for "
       "tfm.max_packing = \"auto\"; lower the onset",
       bed_below_onset},
      {packing_keys({"tfm.max_packing", "bed.solids_fraction", "tfm.frictional_onset"}),
       "tfm.max_packing = \"auto\": the bed is too light to be held at bed.solids_fraction; give a number, e.g. 0.64",
       bed_too_light},
      table_rule("solids_stress", wrong_with_stress_table),
      table_rule("species_exchange", wrong_with_exchange_table)};
}

std::vector<core::Rule> start_rules() {
  return {{packing_keys({"tfm.max_packing", "bed.solids_fraction", "bed.start_solids_fraction", "bed.start",
                         "bed.layer", "layer."}),
           "tfm.max_packing = {}: the bed at its start, with a solids fraction of {}, lies more than {} above; lower "
           "bed.start_solids_fraction",
           start_above_packing},
          {{"bed.start", "effects.solids_stress"},
           "bed.start = \"settled\" needs effects.solids_stress: nothing else carries a bed of this model",
           settled_without_stress},
          {{"bed.start", "column.ends"},
           "bed.start = \"settled\" and column.ends = \"periodic\" contradict each other: there is no bottom that "
           "carries the bed; use \"mixed\"",
           [](const Scene& scene) {
             return core::broken_if(scene.bed.start.kind == core::StartKind::settled &&
                                    scene.column.ends == core::Boundary::periodic);
           }},
          {{"bed.start", "bed.volume_share", "bed.particles", "species.density", "fluid."},
           "bed.start = \"settled\" needs solids heavier than the fluid",
           settled_and_light},
          {{"tfm.integrator", "effects.drag", "fluid.equation_of_state"},
           "tfm.integrator = \"imex\" takes the drag implicitly: it needs {}",
           split_without_drag},
          {{"tfm.rtol", "tfm.integrator", "fluid.", "inlet.superficial_velocity", "jet.", "feed.", "column.closed"},
           "tfm.rtol = {} with the implicit integrator: {}",
           implicit_tolerance}};
}

}  // namespace polybed::tfm
