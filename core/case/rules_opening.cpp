// What parts of the cross-section require: jets, feeds, layers, and an opening that particles fall through.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/case/case_rules.hpp"
#include "core/case/resolve.hpp"
#include "core/case/size_classes.hpp"

namespace polybed::core {

namespace {

/// Coordinates of a corner on the bottom.
std::size_t corner_size(const Scene& scene) { return scene.column.given_size.size() == 3 ? 2 : 1; }

/// The whole end, of a feed; the whole cross-section, of a layer.
bool is_all(const Feed& feed) { return feed.from.empty() && feed.to.empty(); }
bool is_all(const Layer& layer) { return layer.from.empty() && layer.to.empty(); }
bool is_all(const Jet&) { return false; }

template <class Part>
Broken corners_miscounted(const Scene& scene, const std::vector<Part>& parts) {
  Broken broken;
  const std::size_t n = corner_size(scene);
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (!is_all(parts[k]) && (parts[k].from.size() != n || parts[k].to.size() != n))
      broken.add({std::to_string(parts[k].from.size()), std::to_string(parts[k].to.size()), std::to_string(n)},
                 entry_of(scene, parts, k));
  return broken;
}

template <class Part>
Broken beside_the_end(const Scene& scene, const std::vector<Part>& parts) {
  Broken broken;
  const std::vector<double>& given = scene.column.given_size;  // width, then the depth if there are corners in it
  const std::array<double, 2> size{given[0], given[1]};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Part& part = parts[k];
    for (std::size_t d = 0; d < part.from.size(); ++d)
      if (!(part.from[d] < part.to[d] && part.to[d] <= size[d] * (1 + 1e-12))) {
        broken.add(
            {fmt::format("{:.4g}", part.from[d]), fmt::format("{:.4g}", part.to[d]), fmt::format("{:.4g}", size[d])},
            entry_of(scene, parts, k));
        break;
      }
  }
  return broken;
}

/// True if two parts of an end have nothing in common; a part without corners is all of it.
template <class Part>
bool apart(const Part& a, const Part& b) {
  for (std::size_t d = 0; d < std::min(a.from.size(), b.from.size()); ++d)
    if (a.to[d] <= b.from[d] || b.to[d] <= a.from[d]) return true;
  return false;
}

Broken jets_overlap(const Scene& scene) {
  Broken broken;
  for (std::size_t a = 0; a < scene.jets.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (!apart(scene.jets[a], scene.jets[b])) broken.add({std::to_string(b + 1), std::to_string(a + 1)}, a);
  return broken;
}

Broken feeds_overlap(const Scene& scene) {
  Broken broken;
  for (std::size_t a = 0; a < scene.feeds.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const Feed &one = scene.feeds[a], &other = scene.feeds[b];
      if (one.species == other.species && one.at == other.at && !apart(one, other))
        broken.add({one.species, std::to_string(1 + *entry_of(scene, scene.feeds, b)),
                    std::to_string(1 + *entry_of(scene, scene.feeds, a))},
                   entry_of(scene, scene.feeds, a));
    }
  return broken;
}

Broken feeds_of_no_species(const Scene& scene) {
  Broken broken;
  for (std::size_t n = 0; n < scene.feeds.size(); ++n) {
    const std::string& name = scene.feeds[n].species;
    if (std::none_of(scene.species.begin(), scene.species.end(), [&](const auto& s) { return s.name == name; }))
      broken.add({name}, entry_of(scene, scene.feeds, n));
  }
  return broken;
}

Broken feeds_denser_than_the_bed(const Scene& scene) {
  Broken broken;
  const double settled = scene.bed.solids_fraction;
  for (std::size_t n = 0; n < scene.feeds.size(); ++n) {
    const Feed& feed = scene.feeds[n];
    for (const auto& [time, flux] : feed.superficial_velocity)
      if (flux > settled * feed.velocity)
        broken.add({feed.species, fmt::format("{:.4g}", flux), fmt::format("{:.4g}", feed.velocity),
                    fmt::format("{:.4g}", flux / settled)},
                   entry_of(scene, scene.feeds, n));
  }
  return broken;
}

std::vector<Rule> jet_rules() {
  return {{{"jet.from", "jet.to", "column.size"},
           "jet.from and jet.to have {} and {} numbers: {} here",
           [](const Scene& scene) { return corners_miscounted(scene, scene.jets); },
           true},
          {{"jet.from", "jet.to", "column.size"},
           "a jet from {} to {} m does not lie on the bottom, 0 to {} m",
           [](const Scene& scene) { return beside_the_end(scene, scene.jets); }},
          {{"jet.from", "jet.to", "column.size"}, "two jets overlap: [[jet]] number {} and {}", jets_overlap}};
}

std::vector<Rule> layer_corner_rules() {
  return {{{"layer.from", "layer.to", "column.size"},
           "layer.from and layer.to have {} and {} numbers: {} here",
           [](const Scene& scene) { return corners_miscounted(scene, scene.layers); },
           true},
          {{"layer.from", "layer.to", "column.size"},
           "a layer from {} to {} m does not lie in the column, 0 to {} m",
           [](const Scene& scene) { return beside_the_end(scene, scene.layers); },
           true}};
}

std::vector<Rule> feed_rules() {
  return {{{"feed.from", "feed.to", "column.size"},
           "feed.from and feed.to have {} and {} numbers: {} here",
           [](const Scene& scene) { return corners_miscounted(scene, scene.feeds); },
           true},
          {{"feed.from", "feed.to", "column.size"},
           "a feed from {} to {} m does not lie on the bottom, 0 to {} m",
           [](const Scene& scene) { return beside_the_end(scene, scene.feeds); }},
          {{"feed.species", "species.name"}, "feed.species = \"{}\": no such species", feeds_of_no_species},
          {{"feed.superficial_velocity", "feed.velocity", "bed.solids_fraction"},
           "a feed of {} of {} m/s at a velocity of {} m/s would be denser than the settled bed: raise feed.velocity "
           "above {} m/s",
           feeds_denser_than_the_bed},
          {{"feed.from", "feed.to", "feed.species", "feed.at", "column.size"},
           "two feeds of {} overlap: [[feed]] number {} and {}",
           feeds_overlap}};
}

/// Of the opening that particles fall through. \param broken  words after the width of the opening
Rule opening_rule(std::vector<std::string> rests_on, const std::string& message,
                  std::function<Broken(const Scene&)> broken) {
  rests_on.insert(rests_on.begin(), "dem.opening");
  return {std::move(rests_on), "dem.opening = {} m: " + message, [broken = std::move(broken)](const Scene& scene) {
            Broken all;
            if (!scene.dem.opening) return all;
            const Broken found = broken(scene);
            for (const Broken::Fault& fault : found.faults()) {
              Broken::Words words = fault.words;
              words.insert(words.begin(), fmt::format("{:g}", *scene.dem.opening));
              all.add(std::move(words));
            }
            return all;
          }};
}

Broken wider_than_the_bottom(const Scene& scene) {
  Broken broken;
  const double width = *scene.dem.opening;
  const Column& column = scene.column;
  if (width >= column.size[0]) broken.add({fmt::format("{:g}", column.size[0]), "wide"});
  if (column.dimensions == 3 && width >= column.size[2]) broken.add({fmt::format("{:g}", column.size[2]), "deep"});
  return broken;
}

std::vector<Rule> bottom_rules() {
  return {
      opening_rule({"fluid.name"},
                   "a fluid enters there, and particles leave through the top alone (column.outlet = \"open\"); set "
                   "fluid.name = \"none\"",
                   [](const Scene& scene) { return broken_if(scene.fluid.present()); }),
      opening_rule({"column.ends"}, "column.ends = \"periodic\" leaves no bottom to open",
                   [](const Scene& scene) { return broken_if(scene.column.ends == Boundary::periodic); }),
      opening_rule({"column.size"}, "it must be narrower than the bottom, which is {} m {}", wider_than_the_bottom),
      opening_rule({"species.diameter"}, "the largest particle, of {} m, must fit through", [](const Scene& scene) {
        const double largest = largest_diameter(scene);
        return *scene.dem.opening < largest ? Broken({fmt::format("{:g}", largest)}) : Broken();
      })};
}

}  // namespace

std::vector<Rule> opening_rules() {
  std::vector<Rule> rules;
  for (const auto& part : {jet_rules(), layer_corner_rules(), feed_rules(), bottom_rules()})
    rules.insert(rules.end(), part.begin(), part.end());
  return rules;
}

}  // namespace polybed::core
