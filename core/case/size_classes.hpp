// Species with a distribution of sizes give way to their classes when a case is resolved: beyond this step a scene has
// species of one diameter each, and nothing else need know.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::core {

/// The classes of a distribution, (diameter m, share of its volume), from fine to coarse. The closures know the rule;
/// the case file is given it, as it is given the roles.
using ClassRule = std::function<std::vector<std::pair<double, double>>(const SizeDistribution&)>;

/// Puts `name.1`, `name.2`, ... in the place of each species with a distribution: with its properties, its share of
/// bed.volume_share and of [[layer]] divided among them, and in the contact pairs, the feeds and the layers that name
/// it; in a layered bed they are one layer. Fills scene.size_classes. Does nothing to a scene that has no share for
/// each species.
void expand_size_classes(Scene& scene, const ClassRule& rule);

/// The entry in the case that the n-th species, layer, jet, feed, discharge or contact pair of a scene comes from; none
/// of a pair where size classes stand for species.
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
