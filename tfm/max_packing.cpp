#include "tfm/max_packing.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "closures/stress_frictional.hpp"
#include "tfm/initial.hpp"

namespace polybed::tfm {

namespace {

/// The packing for "auto".
double packing_that_carries(const core::Scene& scene, double fluid_density) {
  double excess = 0;
  for (std::size_t j = 0; j < scene.species.size(); ++j)
    excess += scene.bed.volume_share[j] * std::abs(scene.species[j].density - fluid_density);
  const double half_weight = 0.5 * excess * std::max(scene.column.gravity, 1e-3) * settled_height(scene);
  return closures::max_packing_for(scene.bed.solids_fraction, half_weight, scene.tfm.frictional_pressure,
                                   scene.tfm.frictional_onset);
}

}  // namespace

double settled_height(const core::Scene& scene) {
  return scene.bed.static_height > 0 ? solids_height(scene.bed) : scene.column.size[1] * scene.bed.solids_fraction;
}

closures::MixturePacking mixture_rule(const core::Scene& scene) {
  const auto* rule = std::get_if<core::PackingRule>(&scene.tfm.max_packing);
  if (rule == nullptr || *rule == core::PackingRule::automatic) return nullptr;
  return *rule == core::PackingRule::fedors_landel ? closures::packing_fedors_landel : closures::packing_yu_standish;
}

std::vector<double> species_packings(const core::Scene& scene) {
  std::vector<double> packing;
  for (const core::Species& species : scene.species) packing.push_back(species.max_packing);
  return packing;
}

double max_packing_of(const core::Scene& scene, std::span<const double> share, double fluid_density) {
  if (const double* number = std::get_if<double>(&scene.tfm.max_packing)) return *number;
  const closures::MixturePacking rule = mixture_rule(scene);
  if (rule == nullptr) return packing_that_carries(scene, fluid_density);
  std::vector<double> diameter;
  for (const core::Species& species : scene.species) diameter.push_back(species.diameter);
  return rule(share, diameter, species_packings(scene));
}

}  // namespace polybed::tfm
