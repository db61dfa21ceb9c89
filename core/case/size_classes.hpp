// Replaces species with a size distribution by their classes when a case is resolved. Afterwards every species of a
// scene has one diameter.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::core {

/// The classes of a distribution, (diameter m, share of its volume), from fine to coarse. The closures define the rule;
/// it is passed to the reader, as the roles are.
using ClassRule = std::function<std::vector<std::pair<double, double>>(const SizeDistribution&)>;

/// Replaces each species with a distribution by `name.1`, `name.2`, ... with the same properties. Divides its share of
/// bed.volume_share and of [[layer]] among them, and replaces it in contact pairs, feeds and layers; in a layered bed
/// they form one layer. Fills scene.size_classes. Leaves a scene without a share for each species unchanged.
void expand_size_classes(Scene& scene, const ClassRule& rule);

/// The entry in the case that produced the n-th species, layer, jet, feed, discharge or contact pair of a scene;
/// nothing for a pair whose species were replaced by size classes.
[[nodiscard]] std::optional<std::size_t> entry_of(const Scene& scene, const std::vector<Species>& species,
                                                  std::size_t n);
[[nodiscard]] std::optional<std::size_t> entry_of(const Scene& scene, const std::vector<Jet>& jets, std::size_t n);
[[nodiscard]] std::optional<std::size_t> entry_of(const Scene& scene, const std::vector<Layer>& layers, std::size_t n);
[[nodiscard]] std::optional<std::size_t> entry_of(const Scene& scene, const std::vector<Feed>& feeds, std::size_t n);
[[nodiscard]] std::optional<std::size_t> entry_of(const Scene& scene, const std::vector<Discharge>& discharges,
                                                  std::size_t n);
[[nodiscard]] std::optional<std::size_t> entry_of(const Scene& scene, const std::vector<ContactPair>& pairs,
                                                  std::size_t n);

}  // namespace polybed::core
