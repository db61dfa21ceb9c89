#include "multiscale/resolve/rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/case/resolve.hpp"
#include "core/error.hpp"
#include "multiscale/resolve/packing.hpp"
#include "multiscale/resolve/plan.hpp"
#include "relevance/effects/lubrication.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

namespace {

using core::Broken;

/// Least cells per pore: chosen, not measured.
constexpr double least_pore = 3;
/// Density of free spheres over the fluid's: forces of the fluid act on them one step late.
constexpr double least_ratio = 1.1;
/// Width of a box of spheres that travel over the largest diameter: no sphere or film touches another and its image.
/// The range of a film is the unresolved gap on the coarsest grid.
double least_width(const core::Scene& scene) {
  const double cells =
      cells_of(scene.resolve, scene.resolve.grids - 1) * core::largest_diameter(scene) / least_diameter(scene);
  return 2 * (1 + resolved_gap / cells);
}

bool asks(const core::Scene& scene) {
  return !scene.resolve.voidage.empty() && !scene.species.empty() &&
         scene.bed.volume_share.size() == scene.species.size();
}

Broken pores_too_coarse(const core::Scene& scene) {
  Broken broken;
  if (!asks(scene)) return broken;
  const int grid = scene.resolve.grids - 1;
  for (const double eps : scene.resolve.voidage) {
    const double cells = pore_of(eps) * sauter_cells(scene, grid);
    if (cells >= least_pore) continue;
    broken.add({fmt::format("{}", scene.resolve.cells_per_diameter), fmt::format("{:.2g}", cells),
                fmt::format("{:g}", eps), fmt::format("{:g}", least_pore),
                fmt::format("{:.0f}", std::ceil(scene.resolve.cells_per_diameter * least_pore / cells))});
  }
  return broken;
}

bool is_stable(double eps, double re, double sauter_in_cells) {
  return re == 0 || units_of(eps, re, sauter_in_cells).viscosity >= least_viscosity(pore_of(eps) * sauter_in_cells);
}

Broken reynolds_beyond_grid(const core::Scene& scene) {
  Broken broken;
  if (!asks(scene)) return broken;
  const double cells = sauter_cells(scene, scene.resolve.grids - 1);
  for (const double eps : scene.resolve.voidage)
    for (const double re : scene.resolve.reynolds) {
      if (is_stable(eps, re, cells)) continue;
      double more = 1;
      while (!is_stable(eps, re, more * cells)) more += 0.01;
      broken.add({fmt::format("{:g}", re), fmt::format("{:g}", eps),
                  fmt::format("{:.2g}", units_of(eps, re, cells).viscosity),
                  fmt::format("{:.2g}", least_viscosity(pore_of(eps) * cells)),
                  fmt::format("{:.0f}", std::ceil(scene.resolve.cells_per_diameter * more))});
    }
  return broken;
}

Broken species_without_spheres(const core::Scene& scene) {
  Broken broken;
  if (!asks(scene)) return broken;
  const std::vector<std::int64_t> numbers = sphere_numbers(scene);
  for (std::size_t j = 0; j < numbers.size(); ++j)
    if (numbers[j] == 0) broken.add({fmt::format("{}", scene.resolve.spheres), scene.species[j].name});
  return broken;
}

Broken no_spheres(const core::Scene& scene) {
  Broken broken;
  for (std::size_t j = 0; asks(scene) && j < scene.species.size(); ++j)
    if (const core::Species& s = scene.species[j]; s.sphericity < 1)
      broken.add({fmt::format("{:g}", s.sphericity), s.name}, j);
  return broken;
}

bool are_free(const core::Scene& scene) { return scene.resolve.motion == core::SphereMotion::free; }

/// Whether spheres meet others at places that are not those of their packing.
bool travel(const core::Scene& scene) {
  const std::vector<double>& re = scene.resolve.reynolds;
  return are_free(scene) || (scene.resolve.motion == core::SphereMotion::moving && scene.species.size() > 1 &&
                             std::any_of(re.begin(), re.end(), [](double one) { return one > 0; }));
}

Broken reynolds_of_no_use(const core::Scene& scene) {
  if (!are_free(scene) || scene.resolve.reynolds == core::Resolve().reynolds) return {};
  return Broken(Broken::Words{});
}

Broken end_of_no_use(const core::Scene& scene) {
  if (are_free(scene) || !scene.resolve.until) return {};
  return Broken({std::string(core::name_of(scene.resolve.motion))});
}

/// A law for films that the grid resolves; one that was chosen automatically is dropped instead.
Broken film_counted_twice(const core::Scene& scene) {
  using namespace relevance::effects;
  const auto& chosen = scene.chooser.chosen;
  if (!are_free(scene) || !lubrication.has(scene, of_unresolved_flow) ||
      std::find(chosen.begin(), chosen.end(), lubrication.role) != chosen.end())
    return {};
  return Broken({core::law_of(scene, lubrication.role)});
}

Broken nothing_to_fall_in(const core::Scene& scene) {
  if (!are_free(scene)) return {};
  if (!scene.fluid.present()) return Broken({"a fluid"});
  return scene.column.gravity > 0 ? Broken() : Broken({"column.gravity above 0"});
}

/// Whether there are free spheres in a known fluid; another rule reports an unknown one.
bool fall(const core::Scene& scene) {
  if (!are_free(scene) || nothing_to_fall_in(scene) || !asks(scene)) return false;
  try {
    return relevance::fluid_constants(scene.fluid).density > 0;
  } catch (const core::CaseError&) {
    return false;
  }
}

Broken spheres_too_light(const core::Scene& scene) {
  Broken broken;
  if (!fall(scene)) return broken;
  const double density = relevance::fluid_constants(scene.fluid).density;
  for (std::size_t j = 0; j < scene.species.size(); ++j)
    if (const double ratio = scene.species[j].density / density; ratio < least_ratio)
      broken.add({scene.species[j].name, fmt::format("{:.3g}", ratio), fmt::format("{:g}", least_ratio)}, j);
  return broken;
}

Broken box_too_narrow(const core::Scene& scene) {
  Broken broken;
  if (!travel(scene) || !asks(scene) || species_without_spheres(scene)) return broken;
  const double needed = least_width(scene);
  for (const double eps : scene.resolve.voidage) {
    const double width = box_length(scene, eps) / core::largest_diameter(scene);
    if (width >= needed) continue;
    broken.add({fmt::format("{}", scene.resolve.spheres), fmt::format("{:g}", eps), fmt::format("{:.3g}", width),
                fmt::format("{:.3g}", needed),
                fmt::format("{:.0f}", std::ceil(scene.resolve.spheres * std::pow(needed / width, 3)))});
  }
  return broken;
}

Broken fall_beyond_grid(const core::Scene& scene) {
  Broken broken;
  if (!fall(scene) || spheres_too_light(scene)) return broken;
  const int grid = scene.resolve.grids - 1;
  const double cells = cells_of(scene.resolve, grid), sauter = sauter_cells(scene, grid);
  for (const double eps : scene.resolve.voidage) {
    const auto lacks = [&](double more) {
      return units_of_fall(scene, more * cells).viscosity < least_viscosity(pore_of(eps) * more * sauter);
    };
    if (!lacks(1)) continue;
    double more = 1;
    while (lacks(more)) more += 0.01;
    broken.add({fmt::format("{}", scene.resolve.cells_per_diameter), fmt::format("{:g}", eps),
                fmt::format("{:.2g}", units_of_fall(scene, cells).viscosity),
                fmt::format("{:.2g}", least_viscosity(pore_of(eps) * sauter)),
                fmt::format("{:.0f}", std::ceil(scene.resolve.cells_per_diameter * more))});
  }
  return broken;
}

}  // namespace

std::vector<core::Rule> resolve_rules() {
  return {
      {{"resolve.cells_per_diameter", "resolve.voidage", "resolve.grids", "species.diameter", "bed.volume_share"},
       "resolve.cells_per_diameter = {}: the pores are {} cells wide on the coarsest grid at a voidage of {}, they "
       "need {}; take {} or more, or fewer resolve.grids",
       pores_too_coarse},
      {{"resolve.reynolds", "resolve.cells_per_diameter", "resolve.voidage", "resolve.grids", "species.diameter",
        "bed.volume_share"},
       "resolve.reynolds = {} at a voidage of {}: the viscosity would be {} in cells and steps, stable from {}; take "
       "resolve.cells_per_diameter = {} or more, or fewer resolve.grids",
       reynolds_beyond_grid},
      {{"resolve.spheres", "resolve.voidage", "species.diameter", "bed.volume_share"},
       "resolve.spheres = {} leaves none of species '{}': take more",
       species_without_spheres},
      {{"species.sphericity", "resolve.voidage", "bed.volume_share"},
       "species.sphericity = {} of '{}': polybed resolve finds the drag on spheres; leave it out, or [resolve]",
       no_spheres},
      {{"resolve.motion", "resolve.reynolds"},
       "resolve.motion = \"free\": the weight of the spheres decides on the Reynolds number; leave out "
       "resolve.reynolds",
       reynolds_of_no_use},
      {{"resolve.until", "resolve.motion"},
       "resolve.until is the time of free spheres, and resolve.motion = \"{}\": leave out resolve.until",
       end_of_no_use},
      {{"effects.lubrication", "resolve.motion"},
       "effects.lubrication = \"{}\": resolve.motion = \"free\" resolves the flow between spheres; use \"film\" or "
       "\"none\"",
       film_counted_twice},
      {{"resolve.motion", "fluid.name", "column.gravity"}, "resolve.motion = \"free\" needs {}", nothing_to_fall_in},
      {{"species.density", "resolve.motion", "fluid.name", "fluid.density", "fluid.viscosity", "fluid.temperature"},
       "resolve.motion = \"free\": species '{}' is {} times as dense as the fluid; drag acts on free spheres one step "
       "late, which is stable from {} times on",
       spheres_too_light},
      {{"resolve.cells_per_diameter", "resolve.motion", "resolve.voidage", "resolve.grids", "species.diameter",
        "species.density", "bed.volume_share", "fluid.name", "fluid.density", "fluid.viscosity", "fluid.temperature"},
       "resolve.cells_per_diameter = {}: free spheres at a voidage of {} would fall at a viscosity of {} in cells and "
       "steps, stable from {}; take {} or more, or fewer resolve.grids",
       fall_beyond_grid},
      {{"resolve.spheres", "resolve.motion", "resolve.reynolds", "resolve.voidage", "species.diameter",
        "bed.volume_share"},
       "resolve.spheres = {}: at a voidage of {} the box is {} of the largest diameters wide; spheres that travel need "
       "{}, so that none touches another and its image: take {} or more",
       box_too_narrow}};
}

}  // namespace polybed::multiscale
