// Requirements on [[layer]]: its contents, its position on the layers below it, and no second definition of either.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/case/case_rules.hpp"
#include "core/case/keys.hpp"
#include "core/case/layers.hpp"
#include "core/case/size_classes.hpp"

namespace polybed::core {

namespace {

/// A rule that each layer can break. \param words  of a layer and its number from 1; empty: the rule is satisfied
template <class Words>
Broken layers_that_break(const Scene& scene, const Words& words) {
  Broken broken;
  for (std::size_t n = 0; n < scene.layers.size(); ++n)
    if (Broken::Words found = words(scene.layers[n], n + 1); !found.empty()) broken.add(std::move(found), n);
  return broken;
}

Broken started_otherwise(const Scene& scene) {
  const StartKind start = scene.bed.start.kind;
  if (scene.layers.empty() || start == StartKind::layered || start == StartKind::checkpoint) return {};
  return Broken({text_of(scene.bed.start)});
}

Broken shares_otherwise(const Scene& scene) {
  if (scene.layers.empty()) return {};
  const std::vector<double> share = totals_of_layers(scene).share, &given = scene.bed.volume_share;
  return broken_if(!std::equal(share.begin(), share.end(), given.begin(), given.end(),
                               [](double a, double b) { return std::abs(a - b) <= 1e-9; }));
}

Broken height_otherwise(const Scene& scene) {
  if (scene.layers.empty()) return {};
  const double height = scene.column.filled_height(totals_of_layers(scene).solids / scene.bed.solids_fraction);
  return broken_if(!(std::abs(scene.bed.static_height - height) <= 1e-9 * height));
}

/// Keys that a bed with layers must not give, or only with the values of the layers.
std::vector<Rule> beside_layers() {
  return {{{"bed.start", "layer"},
           "bed.start = \"{}\" and [[layer]] both say where the bed starts: leave bed.start out",
           started_otherwise,
           true},
          {{"bed.particles", "layer"},
           "bed.particles and [[layer]] both say how much there is: leave bed.particles out",
           [](const Scene& scene) { return broken_if(!scene.layers.empty() && !scene.bed.particles.empty()); },
           true},
          {{"bed.layer", "layer"},
           "bed.layer and [[layer]] both say what the layers are: leave bed.layer out",
           [](const Scene& scene) { return broken_if(!scene.layers.empty() && !scene.bed.layer.empty()); }},
          {{"bed.volume_share", "bed.static_height", "bed.start"},
           "bed.volume_share differs from the shares in [[layer]]: leave bed.volume_share out",
           shares_otherwise},
          {{"bed.static_height", "bed.volume_share", "bed.solids_fraction", "bed.start"},
           "bed.static_height differs from the amount in [[layer]]: leave bed.static_height out",
           height_otherwise}};
}

Broken layers_of_no_species(const Scene& scene) {
  std::vector<std::string> names;
  for (const Species& species : scene.species) names.push_back(species.name);
  return layers_that_break(scene, [&](const Layer& layer, std::size_t) -> Broken::Words {
    const bool known = std::find(names.begin(), names.end(), layer.species) != names.end();
    if (layer.species.empty() || !layer.volume_share.empty() || known) return {};
    const std::string near = nearest_name(layer.species, names);
    return {layer.species, near.empty() ? fmt::format("there are {}", fmt::join(names, ", "))
                                        : fmt::format("did you mean '{}'?", near)};
  });
}

Broken layers_of_both_or_neither(const Scene& scene) {
  return layers_that_break(scene, [](const Layer& layer, std::size_t number) -> Broken::Words {
    if (layer.species.empty() != layer.volume_share.empty()) return {};
    return {std::to_string(number), layer.species.empty() ? "neither" : "both"};
  });
}

Broken layers_miscounted(const Scene& scene) {
  return layers_that_break(scene, [&](const Layer& layer, std::size_t) -> Broken::Words {
    const std::size_t given = layer.volume_share.size();
    if (given == 0 || given == scene.species.size()) return {};
    return {std::to_string(given), std::to_string(scene.species.size())};
  });
}

Broken layers_not_whole(const Scene& scene) {
  return layers_that_break(scene, [](const Layer& layer, std::size_t) -> Broken::Words {
    const double sum = std::accumulate(layer.volume_share.begin(), layer.volume_share.end(), 0.0);
    if (layer.volume_share.empty() || std::abs(sum - 1) <= 1e-9) return {};
    return {fmt::format("{:.9g}", sum)};
  });
}

/// Rules for the contents of each layer.
std::vector<Rule> within_layers() {
  return {
      {{"layer", "layer.species", "layer.volume_share"},
       "[[layer]] number {} has {} of layer.species and layer.volume_share: give one of them",
       layers_of_both_or_neither,
       true},
      {{"layer.species", "species.name"}, "layer.species = \"{}\": no such species; {}", layers_of_no_species, true},
      {{"layer.volume_share", "species.name"},
       "layer.volume_share has {} numbers, there are {} species",
       layers_miscounted,
       true},
      {{"layer.volume_share"}, "layer.volume_share sums to {}, not to 1", layers_not_whole, true}};
}

Broken layers_uneven(const Scene& scene) {
  if (scene.layers.empty()) return {};
  const std::vector<BedPart> parts = start_parts(scene);
  std::vector<double> settled;
  for (const Layer& layer : scene.layers) settled.push_back(layer.height);
  const std::vector<Extent> extents = stacked(parts, settled);
  return layers_that_break(scene, [&](const Layer&, std::size_t number) -> Broken::Words {
    const double share = supported_share(parts, extents, number - 1);
    if (share > 1 - 1e-9) return {};
    return {std::to_string(number), fmt::format("{:.3g}", 100 * share), fmt::format("{:.4g}", extents[number - 1].low)};
  });
}

}  // namespace

std::vector<Rule> layer_rules() {
  std::vector<Rule> rules = beside_layers();
  for (const Rule& rule : within_layers()) rules.push_back(rule);
  rules.push_back({{"layer", "layer.from", "layer.to", "layer.height", "column.size", "bed.start", "bed.volume_share"},
                   "[[layer]] number {} does not lie level: only {} % of it lies on layers up to {} m high; give a "
                   "[[layer]] for each part",
                   layers_uneven});
  return rules;
}

}  // namespace polybed::core
