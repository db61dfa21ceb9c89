#include "multiscale/card/layer_bed.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "closures/mixture.hpp"
#include "core/case/layers.hpp"

namespace polybed::multiscale {

using closures::CarriedBed;

CarriedBed mixture_of(const core::Scene& scene, const std::vector<double>& share,
                      const relevance::FluidConstants& fluid, double gravity) {
  std::vector<double> part, diameter;
  double density = 0;
  const double sum = std::accumulate(share.begin(), share.end(), 0.0);
  for (std::size_t j = 0; j < share.size(); ++j) {
    if (!(share[j] > 0)) continue;
    part.push_back(share[j] / sum);
    diameter.push_back(scene.species[j].diameter);
    density += part.back() * scene.species[j].density;
  }
  return {closures::sauter_diameter(part, diameter), density - fluid.density, fluid.density, fluid.viscosity, gravity};
}

std::vector<LayerBed> layers_of(const core::Scene& scene, const Slices& slices, const std::vector<double>& share,
                                const relevance::FluidConstants& fluid, double gravity) {
  constexpr double across = 1 - 1e-9;  // of the cross-section, up to round-off
  const std::vector<core::BedPart> parts = core::start_parts(scene);
  std::vector<LayerBed> layers;
  for (std::size_t n = 0; n < parts.size() && parts.size() > 1 && slices.empty(); ++n) {
    if (parts[n].area() < across) return {};
    std::vector<double> solids = parts[n].solids;
    for (std::size_t j = 0; j < solids.size(); ++j) solids[j] *= share[j] > 0 ? 1 : 0;
    const double all = std::accumulate(solids.begin(), solids.end(), 0.0);
    if (!(all > 0)) continue;
    const double settled = scene.layers.empty() ? scene.bed.solids_fraction
                                                : scene.layers[n].solids_fraction.value_or(scene.bed.solids_fraction);
    const auto first = std::find_if(solids.begin(), solids.end(), [](double one) { return one > 0; });
    LayerBed& layer = layers.emplace_back(mixture_of(scene, solids, fluid, gravity), 1 - settled, all);
    if (!(layer.bed.excess > 0)) return {};
    if (*first == all) layer.only = std::size_t(first - solids.begin());
  }
  return layers;
}

std::vector<LayerBed> layers_of_species(const core::Scene& scene, const std::vector<double>& solids,
                                        const relevance::FluidConstants& fluid, double gravity) {
  const std::vector<double> settled = core::settled_fractions(scene).of_species;
  std::vector<LayerBed> layers;
  for (std::size_t j = 0; j < solids.size(); ++j) {
    if (!(solids[j] > 0)) continue;
    std::vector<double> only(solids.size(), 0);
    only[j] = 1;
    layers.push_back({mixture_of(scene, only, fluid, gravity), 1 - settled[j], solids[j], j});
  }
  return layers;
}

std::optional<PartedBed> parted(const core::Scene& scene, const Balance& balance, const std::vector<LayerBed>& layers,
                                double velocity) {
  constexpr double least = 1.05;  // ratio of bulk densities
  struct Part {
    double bulk, height;
    std::size_t species;
  };
  std::vector<Part> parts;
  for (const LayerBed& layer : layers) {
    if (!(layer.bed.excess > 0)) return {};
    const std::optional<Filled> filled = layer.of(balance).height({}, layer.bed, velocity, layer.solids);
    const double height = filled ? filled->height : HUGE_VAL;
    parts.push_back({layer.bed.excess * layer.solids / height, height, *layer.only});
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.bulk > b.bulk; });
  if (parts.size() < 2 || parts.front().bulk < least * parts.back().bulk) return {};
  PartedBed bed;
  for (const Part& part : parts) {
    bed.height += part.height;
    if (bed.height >= scene.column.size[1]) bed.leaving.push_back(scene.species[part.species].name);
  }
  return bed;
}

std::vector<double> lifting_velocities(const Balance& balance, const std::vector<LayerBed>& layers, double of_one) {
  std::vector<double> all;
  for (const LayerBed& layer : layers)
    if (const auto one = layer.of(balance).minimum_fluidisation(layer.bed)) all.push_back(*one);
  return all.empty() ? std::vector{of_one} : all;
}

bool turns_over(const Balance& balance, const std::vector<LayerBed>& layers, double velocity) {
  constexpr double more = 1 + 1e-9;  // equal layers up to round-off
  double below = HUGE_VAL;
  for (const LayerBed& layer : layers) {
    const std::optional<Filled> filled = layer.of(balance).height({}, layer.bed, velocity, layer.solids);
    if (!filled) return false;
    const double bulk = layer.bed.excess * layer.solids / filled->height;
    if (bulk > more * below) return true;
    below = bulk;
  }
  return false;
}

}  // namespace polybed::multiscale
