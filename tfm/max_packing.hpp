// The maximum packing of the whole bed, from the case.
#pragma once

#include <span>
#include <vector>

#include "closures/max_packing.hpp"
#include "core/case/scene.hpp"

namespace polybed::tfm {

/// Volume of the settled solids per area, m; for a column that starts without solids, as if it were full of them.
[[nodiscard]] double settled_height(const core::Scene& scene);

/// The mixture rule in tfm.max_packing; null for a number and for "auto".
[[nodiscard]] closures::MixturePacking mixture_rule(const core::Scene& scene);

/// phi_max of each species alone.
[[nodiscard]] std::vector<double> species_packings(const core::Scene& scene);

/// phi_max for shares of the species: tfm.max_packing as a number, or from its mixture rule. For "auto" it gives the
/// settled bed bed.solids_fraction under half its own weight; 1 or more if the bed is too light.
/// \param fluid_density  kg/m3
[[nodiscard]] double max_packing_of(const core::Scene& scene, std::span<const double> share, double fluid_density);

}  // namespace polybed::tfm
