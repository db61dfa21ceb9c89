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
/// bed.volume_share divided among them, and in
/// the contact pairs and the feeds that name it; in a layered bed they are one layer. Fills scene.size_classes. Does
/// nothing to a scene that has no share for each species.
void expand_size_classes(Scene& scene, const ClassRule& rule);

/// The entry in the case of a species, a contact pair, a jet or a feed; none where size classes stand for entries.
[[nodiscard]] inline std::optional<std::size_t> entry_of(const Scene& scene, std::size_t n) {
  return scene.size_classes.empty() ? std::optional(n) : std::nullopt;
}

}  // namespace polybed::core
