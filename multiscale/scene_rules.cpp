#include "multiscale/scene_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "closures/max_packing.hpp"
#include "closures/sphere.hpp"
#include "core/case/file.hpp"
#include "core/error.hpp"
#include "dem/effects.hpp"
#include "fluid/gas_slip.hpp"
#include "fluid/properties.hpp"
#include "multiscale/effects/conflicts.hpp"
#include "multiscale/roles.hpp"
#include "tfm/effects.hpp"
#include "tfm/packing_limit.hpp"

namespace polybed::multiscale {

namespace {

using core::SceneFault;
using Faults = std::vector<SceneFault>;

const double densest_of_one_size = std::numbers::pi / std::sqrt(18.0);  ///< spheres in a crystal

void add_fluid(const core::Scene& scene, Faults& faults) {
  if (!scene.fluid.present()) return;
  try {
    (void)fluid::fluid_constants(scene.fluid);
  } catch (const core::CaseError& error) {
    faults.push_back({"fluid.name", {"fluid.temperature", "fluid.density", "fluid.viscosity"}, error.what()});
    return;
  }
  if (core::law_of(scene, "gas_slip") == core::automatic) return;
  try {
    (void)fluid::slip_divisors(scene, {});
  } catch (const core::CaseError& error) {
    faults.push_back({"effects.gas_slip", {"fluid."}, error.what()});
  }
}

bool shares_are_known(const core::Scene& scene) {
  return !scene.species.empty() && scene.bed.volume_share.size() == scene.species.size();
}

/// Solids fraction beyond which spheres of these sizes cannot be packed, each size alone in a crystal.
double densest_packing(const core::Scene& scene) {
  std::vector<double> diameter, packing;
  for (const core::Species& species : scene.species) {
    diameter.push_back(species.diameter);
    packing.push_back(std::max(densest_of_one_size, species.max_packing));
  }
  return closures::packing_yu_standish(scene.bed.volume_share, diameter, packing);
}

/// Share of the whole column that the solids fill.
double share_of_column(const core::Scene& scene) {
  const core::Bed& bed = scene.bed;
  const auto& size = scene.column.size;
  if (bed.particles.size() != scene.species.size()) return bed.static_height * bed.solids_fraction / size[1];
  double volume = 0;
  for (std::size_t j = 0; j < bed.particles.size(); ++j)
    volume += double(bed.particles[j]) * closures::sphere_volume(0.5 * scene.species[j].diameter);
  return volume / (size[0] * size[1] * size[2]);
}

/// Solids at the start against the greatest packing of the two-fluid model, where the case gives it as a number: a run
/// stops where they lie above it by as much.
void add_start_packing(const core::Scene& scene, Faults& faults) {
  const core::Bed& bed = scene.bed;
  const double* given = std::get_if<double>(&scene.tfm.max_packing);
  if (core::law_of(scene, "solids_stress") == "none" || given == nullptr) return;
  if (bed.start_solids_fraction - *given <= tfm::most_above_packing) return;
  faults.push_back(
      {"tfm.max_packing",
       {"bed.solids_fraction", "bed.start_solids_fraction", "bed.start"},
       fmt::format("tfm.max_packing = {}: the bed at its start, with a solids fraction of {:.4g}, lies more "
                   "than {:g} above; lower bed.start_solids_fraction",
                   *given, bed.start_solids_fraction, tfm::most_above_packing)});
}

void add_packing(const core::Scene& scene, Faults& faults) {
  if (!shares_are_known(scene)) return;
  const std::vector<std::string> sizes{"species.diameter", "species.max_packing", "bed.volume_share", "bed.particles"};
  const double densest = densest_packing(scene);
  if (scene.bed.solids_fraction > densest)
    faults.push_back({"bed.solids_fraction", sizes,
                      fmt::format("bed.solids_fraction = {}: spheres of these sizes fill at most {:.3g} of the volume, "
                                  "and about 0.6 when they settle",
                                  scene.bed.solids_fraction, densest)});
  if (scene.bed.start.kind == core::StartKind::random && share_of_column(scene) > densest)
    faults.push_back(
        {"bed.start",
         {"species.diameter", "bed.volume_share", "bed.particles", "column.", "dem.skin", "bed.static_height",
          "bed.solids_fraction"},
         fmt::format("bed.start = \"random\": the particles would fill {:.3g} of the column, spheres of these "
                     "sizes fill at most {:.3g}: enlarge column.size, or take fewer",
                     share_of_column(scene), densest)});
  add_start_packing(scene, faults);
}

/// The least velocity of a table, m/s.
double least_velocity(const std::vector<std::pair<double, double>>& table) {
  double least = 0;
  for (const auto& [time, velocity] : table) least = std::min(least, velocity);
  return least;
}

/// Whether fluid flows in at the bottom at some time.
bool flows_in(const core::Scene& scene) {
  const auto positive = [](const auto& table) {
    return std::any_of(table.begin(), table.end(), [](const auto& point) { return point.second > 0; });
  };
  return positive(scene.inlet.superficial_velocity) ||
         std::any_of(scene.jets.begin(), scene.jets.end(),
                     [&](const core::Jet& jet) { return positive(jet.superficial_velocity); });
}

}  // namespace

std::vector<core::SceneFault> scene_faults(const core::Scene& scene) {
  Faults faults = role_conflicts(scene);
  for (const auto& of_model : {dem::effect_faults(scene), tfm::effect_faults(scene)})
    faults.insert(faults.end(), of_model.begin(), of_model.end());
  add_fluid(scene, faults);
  add_packing(scene, faults);
  return faults;
}

std::vector<std::string> scene_warnings(const core::Scene& scene) {
  std::vector<std::string> warnings;
  const auto drawn = [&](const std::string& what, double velocity) {
    if (velocity < 0)
      warnings.push_back(
          fmt::format("{} = {:.4g} m/s is negative: fluid leaves at the bottom and enters at the top, "
                      "and the bed is pressed down",
                      what, velocity));
  };
  drawn("inlet.superficial_velocity", least_velocity(scene.inlet.superficial_velocity));
  for (std::size_t n = 0; n < scene.jets.size(); ++n)
    drawn(fmt::format("superficial_velocity of [[jet]] number {}", n + 1),
          least_velocity(scene.jets[n].superficial_velocity));
  if (!scene.fluid.present() || !(scene.column.gravity > 0) || !flows_in(scene)) return warnings;
  const double density = fluid::fluid_constants(scene.fluid).density;
  for (const core::Species& species : scene.species)
    if (species.density < density)
      warnings.push_back(
          fmt::format("species \"{}\" ({:.4g} kg/m3) is lighter than the fluid ({:.4g} kg/m3), which flows in "
                      "from below: it floats up and {}",
                      species.name, species.density, density,
                      scene.column.outlet == core::Outlet::open ? "leaves at the top" : "gathers under the screen"));
  return warnings;
}

core::Scene read_case(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  return core::read_case(path, overrides, all_roles(), size_classes, scene_faults);
}

}  // namespace polybed::multiscale
