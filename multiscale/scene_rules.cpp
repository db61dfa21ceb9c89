#include "multiscale/scene_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "closures/max_packing.hpp"
#include "closures/sphere.hpp"
#include "core/case/file.hpp"
#include "core/case/size_classes.hpp"
#include "core/error.hpp"
#include "core/numerics/blocks.hpp"
#include "dem/rules.hpp"
#include "fluid/inlet.hpp"
#include "fluid/open_face.hpp"
#include "multiscale/calibrate/plan.hpp"
#include "multiscale/particle_requirements.hpp"
#include "multiscale/resolve/rules.hpp"
#include "multiscale/roles.hpp"
#include "relevance/drag_file.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/fluid_properties.hpp"
#include "tfm/rules.hpp"

namespace polybed::multiscale {

namespace {

double packing_of_shares(const core::Scene& scene, const std::vector<double>& share, double of_one_size) {
  std::vector<double> diameter, packing;
  for (const core::Species& species : scene.species) {
    diameter.push_back(species.diameter);
    packing.push_back(std::max(of_one_size, species.max_packing));
  }
  return closures::packing_yu_standish(share, diameter, packing);
}

}  // namespace

double packing_of_sizes(const core::Scene& scene, double of_one_size) {
  return packing_of_shares(scene, scene.bed.volume_share, of_one_size);
}

namespace {

using core::Broken;

Broken fluid_unknown(const core::Scene& scene) {
  if (!scene.fluid.present()) return {};
  try {
    (void)relevance::fluid_constants(scene.fluid);
  } catch (const core::CaseError& error) {
    return Broken({error.what()});
  }
  return {};
}

/// Problems other than at the temperature of the case.
Broken fluid_unknown_in_range(const core::Scene& scene) {
  if (scene.chooser.temperature_range.empty() || fluid_unknown(scene)) return {};
  for (const double kelvin : scene.chooser.temperature_range) {
    core::Scene there = scene;
    there.fluid.temperature = kelvin;
    if (Broken broken = fluid_unknown(there)) return broken;
  }
  return {};
}

bool shares_are_known(const core::Scene& scene) {
  return !scene.species.empty() && scene.bed.volume_share.size() == scene.species.size();
}

/// Solids fraction above which spheres of these sizes cannot be packed, even with each size alone in a crystal.
double densest_packing(const core::Scene& scene) { return packing_of_sizes(scene, closures::crystal_packing); }

/// Share of the whole column occupied by the solids.
double share_of_column(const core::Scene& scene) {
  const core::Bed& bed = scene.bed;
  const double height = scene.column.even_height(scene.column.size[1]);
  if (bed.particles.size() != scene.species.size())
    return scene.column.even_height(bed.static_height) * bed.solids_fraction / height;
  double volume = 0;
  for (std::size_t j = 0; j < bed.particles.size(); ++j)
    volume += double(bed.particles[j]) * closures::sphere_volume(0.5 * scene.species[j].diameter);
  return volume / (scene.column.cross_section() * height);
}

Broken denser_than_spheres_pack(const core::Scene& scene) {
  const double densest = shares_are_known(scene) ? densest_packing(scene) : 1;
  if (scene.bed.solids_fraction <= densest) return {};
  return Broken({fmt::format("{}", scene.bed.solids_fraction), fmt::format("{:.3g}", densest)});
}

Broken layers_denser_than_spheres_pack(const core::Scene& scene) {
  Broken broken;
  for (std::size_t n = 0; n < scene.layers.size(); ++n) {
    const core::Layer& layer = scene.layers[n];
    const double fraction = layer.solids_fraction.value_or(0);
    const double densest = packing_of_shares(scene, layer.volume_share, closures::crystal_packing);
    if (fraction > densest) broken.add({fmt::format("{}", fraction), fmt::format("{:.3g}", densest)}, n);
  }
  return broken;
}

Broken more_than_the_column_takes(const core::Scene& scene) {
  if (!shares_are_known(scene) || scene.bed.start.kind != core::StartKind::random) return {};
  const double densest = densest_packing(scene), share = share_of_column(scene);
  return share > densest ? Broken({fmt::format("{:.3g}", share), fmt::format("{:.3g}", densest)}) : Broken();
}

/// Ports that share a face of a cell with a discharge whose flow follows from its pressure.
core::Broken beside_an_open_side(const core::Scene& scene) {
  core::Broken broken;
  if (!fluid::has_open_sides(scene)) return broken;
  const core::Grid grid = core::grid_of(scene, nullptr);
  const auto shares = [&](const auto& part) { return fluid::face_shares(grid, part.from, part.to, part.at); };
  for (std::size_t n = 0; n < scene.discharges.size(); ++n) {
    if (!scene.discharges[n].pressure) continue;
    const std::vector<double> own = shares(scene.discharges[n]);
    const auto see = [&](const auto& parts, const char* table, std::size_t but) {
      for (std::size_t k = 0; k < parts.size(); ++k) {
        if (k == but || parts[k].at != scene.discharges[n].at) continue;
        const std::vector<double> other = shares(parts[k]);
        bool meet = false;
        for (std::size_t f = 0; f < own.size(); ++f) meet = meet || (own[f] > 0 && other[f] > 0);
        if (meet) broken.add({std::to_string(n + 1), table, std::to_string(1 + *core::entry_of(scene, parts, k))}, n);
      }
    };
    see(scene.jets, "jet", scene.jets.size());
    see(scene.feeds, "feed", scene.feeds.size());
    see(scene.discharges, "discharge", n);
  }
  return broken;
}

/// Rules for the fluid and the bed, whatever effects there are.
std::vector<core::Rule> scene_rules_of_both() {
  return {{{"fluid.name", "fluid.temperature", "fluid.density", "fluid.viscosity"}, "{}", fluid_unknown},
          {{"chooser.temperature_range", "fluid.name", "fluid.temperature", "fluid.density", "fluid.viscosity"},
           "chooser.temperature_range: {}",
           fluid_unknown_in_range},
          {{"chooser.temperature_range", "fluid.name", "fluid.density", "fluid.viscosity"},
           "chooser.temperature_range cannot act: fluid.density and fluid.viscosity are given as numbers",
           [](const core::Scene& scene) {
             return core::broken_if(!scene.chooser.temperature_range.empty() && scene.fluid.present() &&
                                    scene.fluid.density && scene.fluid.viscosity);
           }},
          {{"bed.solids_fraction", "species.diameter", "species.max_packing", "bed.volume_share", "bed.particles"},
           "bed.solids_fraction = {}: spheres of these sizes fill at most {} of the volume, and about 0.6 when they "
           "settle",
           denser_than_spheres_pack},
          {{"layer.solids_fraction", "bed.solids_fraction", "layer.", "species.", "bed.volume_share", "bed.start"},
           "layer.solids_fraction = {}: spheres of these sizes fill at most {} of the volume, and about 0.6 when they "
           "settle",
           layers_denser_than_spheres_pack},
          {{"discharge.pressure", "discharge.", "jet.", "feed.", "column.", "species.name", "species.diameter"},
           "[[discharge]] number {} has a pressure and shares a cell with [[{}]] number {}: move them apart, or take "
           "smaller cells",
           beside_an_open_side},
          {{"bed.start", "species.diameter", "bed.volume_share", "bed.particles", "column.", "dem.skin",
            "bed.static_height", "bed.solids_fraction"},
           "bed.start = \"random\": the particles would fill {} of the column, spheres of these sizes fill at most {}: "
           "enlarge column.size, or take fewer",
           more_than_the_column_takes}};
}

}  // namespace

const std::vector<core::Rule>& scene_rules() {
  static const std::vector<core::Rule> all = relevance::joined(
      {relevance::rules_of(menu(), "tfm, dem"), calibrate_rules(), resolve_rules(), scene_rules_of_both()});
  return all;
}

const core::ModelRules& rules_of_tfm() {
  static const core::ModelRules all{
      "tfm", tfm::model_rules(),
      relevance::joined({relevance::rules_of(menu(), "tfm"), tfm::key_rules(), tfm::start_rules()})};
  return all;
}

const core::ModelRules& rules_of_dem() {
  static const core::ModelRules all{
      "dem", relevance::joined({dem::model_rules(), {dem::contact_rule()}}),
      relevance::joined({relevance::rules_of(menu(), "dem"), dem::key_rules(), dem::start_rules()})};
  return all;
}

core::Scene read_case(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                      const Models& models) {
  return core::read_case(path, overrides, all_roles(), size_classes, core::Rulebook(scene_rules(), models),
                         core::OtherRoles::chosen);
}

core::Scene read_chosen_case(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                             const Models& models) {
  core::Scene chosen = with_choice(read_case(path, overrides, models));
  if (!chosen.chooser.chosen.empty()) refuse(chosen, models);  // chosen effects in addition to given ones
  choose_stiffness(chosen);
  choose_fluid_every(chosen);
  if (const auto file = relevance::drag_file(chosen.drag().name))
    chosen.drag_record = relevance::record_of(*file, relevance::read_drag_file(*file));
  return chosen;
}

core::Json refusals_of(const core::Scene& scene) {
  core::Json json;
  for (const core::ModelRules* model : either_model()) json[model->model] = core::texts_of(model->problems(scene));
  return json;
}

void refuse(const core::Scene& scene, const Models& models) {
  const core::Rulebook rulebook(scene_rules(), models);
  if (const auto problems = rulebook.refusals(scene); !problems.empty()) throw core::CaseError(problems);
}

}  // namespace polybed::multiscale
