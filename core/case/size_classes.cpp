#include "core/case/size_classes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace polybed::core {

namespace {

/// The species that replace one in the case, with their shares of its volume.
struct Expanded {
  std::vector<Species> species;
  std::vector<double> share;
};

Expanded expanded(const Species& given, const ClassRule& rule, std::vector<SizeClasses>& records) {
  if (!given.sizes.kind) return {{given}, {1.0}};
  Expanded result;
  SizeClasses record{given.name, given.sizes, {}, {}};
  for (const auto& [diameter, share] : rule(given.sizes)) {
    Species one = given;
    one.name = fmt::format("{}.{}", given.name, result.species.size() + 1);
    one.diameter = diameter;
    one.sizes = {};
    result.species.push_back(one);
    result.share.push_back(share);
    record.diameter.push_back(diameter);
    record.share.push_back(share);
  }
  records.push_back(std::move(record));
  return result;
}

auto record_of(const std::string& name, const std::vector<SizeClasses>& records) {
  return std::find_if(records.begin(), records.end(), [&](const auto& r) { return r.species == name; });
}

/// The names that replace a name in the case.
std::vector<std::string> names_of(const std::string& name, const std::vector<SizeClasses>& records) {
  const auto record = record_of(name, records);
  if (record == records.end()) return {name};
  std::vector<std::string> names;
  for (std::size_t n = 1; n <= record->diameter.size(); ++n) names.push_back(fmt::format("{}.{}", name, n));
  return names;
}

/// Replaces a pair that names a distribution by a pair for each of its classes.
std::vector<ContactPair> expanded_pairs(const std::vector<ContactPair>& pairs,
                                        const std::vector<SizeClasses>& records) {
  std::vector<ContactPair> result;
  for (const ContactPair& pair : pairs) {
    if (pair.between.size() != 2) return pairs;  // a rule reports it
    for (const std::string& a : names_of(pair.between[0], records))
      for (const std::string& b : names_of(pair.between[1], records)) {
        if (pair.between[0] == pair.between[1] && b < a) continue;
        result.push_back(pair);
        result.back().between = {a, b};
      }
  }
  return result;
}

/// Replaces a feed of a distribution by a feed of each of its classes, by their shares.
std::vector<Feed> expanded_feeds(const std::vector<Feed>& feeds, const std::vector<SizeClasses>& records) {
  std::vector<Feed> result;
  for (const Feed& feed : feeds) {
    const auto record = record_of(feed.species, records);
    if (record == records.end()) {
      result.push_back(feed);
      continue;
    }
    for (std::size_t n = 0; n < record->share.size(); ++n) {
      result.push_back(feed);
      result.back().species = fmt::format("{}.{}", feed.species, n + 1);
      for (auto& point : result.back().superficial_velocity) point.second *= record->share[n];
    }
  }
  return result;
}

/// Share of one species of the case in a layer.
double share_in(const Layer& layer, const std::vector<Species>& species, std::size_t n) {
  if (layer.volume_share.empty()) return layer.species == species[n].name ? 1 : 0;
  return layer.volume_share[n];
}

/// Whether every layer that gives shares gives one for each species. A rule reports those that do not.
bool layers_fit(const std::vector<Layer>& layers, std::size_t species) {
  return std::all_of(layers.begin(), layers.end(), [&](const Layer& layer) {
    return layer.volume_share.empty() || layer.volume_share.size() == species;
  });
}

/// Divides the share of a species in each layer among its size classes. \param classes  of each species of the case
void expand_layers(std::vector<Layer>& layers, const std::vector<Species>& given,
                   const std::vector<Expanded>& classes) {
  for (Layer& layer : layers) {
    std::vector<double> shares;
    bool known = !layer.volume_share.empty();
    for (std::size_t n = 0; n < given.size(); ++n) {
      const double share = share_in(layer, given, n);
      known = known || share > 0;
      for (const double part : classes[n].share) shares.push_back(share * part);
    }
    if (!known) continue;  // unknown, which a rule reports, or a single class
    if (layer.volume_share.empty()) layer.species.clear();
    layer.volume_share = std::move(shares);
  }
}

/// Number of entries before part n of `size`. All classes of a distribution, one after the other, come from one entry.
template <class Name>
std::size_t entries_before(const Scene& scene, std::size_t size, std::size_t n, Name&& name_of_part) {
  std::size_t entry = 0;
  for (std::size_t first = 0;; ++entry) {
    std::size_t count = 1;
    for (const SizeClasses& record : scene.size_classes) {
      const std::size_t all = record.diameter.size();
      if (first + all <= size && name_of_part(first) == record.species + ".1" &&
          name_of_part(first + all - 1) == fmt::format("{}.{}", record.species, all))
        count = all;
    }
    first += count;
    if (n < first) return entry;
  }
}

}  // namespace

std::optional<std::size_t> entry_of(const Scene& scene, const std::vector<Species>& species, std::size_t n) {
  return entries_before(scene, species.size(), n, [&](std::size_t k) { return species[k].name; });
}
std::optional<std::size_t> entry_of(const Scene&, const std::vector<Jet>&, std::size_t n) { return n; }
std::optional<std::size_t> entry_of(const Scene&, const std::vector<Discharge>&, std::size_t n) { return n; }
std::optional<std::size_t> entry_of(const Scene&, const std::vector<Layer>&, std::size_t n) { return n; }
std::optional<std::size_t> entry_of(const Scene& scene, const std::vector<Feed>& feeds, std::size_t n) {
  return entries_before(scene, feeds.size(), n, [&](std::size_t k) { return feeds[k].species; });
}
std::optional<std::size_t> entry_of(const Scene& scene, const std::vector<ContactPair>&, std::size_t n) {
  return scene.size_classes.empty() ? std::optional(n) : std::nullopt;
}

void expand_size_classes(Scene& scene, const ClassRule& rule) {
  if (std::none_of(scene.species.begin(), scene.species.end(), [](const auto& s) { return s.sizes.kind.has_value(); }))
    return;
  Bed& bed = scene.bed;
  const bool shares_fit = bed.volume_share.size() == scene.species.size();
  const bool by_layers = !scene.layers.empty() && bed.volume_share.empty();
  if (!shares_fit && !by_layers && bed.start.kind != StartKind::list) return;  // a rule reports it
  if (!layers_fit(scene.layers, scene.species.size())) return;
  std::vector<Species> species;
  std::vector<double> shares;
  std::vector<std::int64_t> layer;
  const bool layer_fits = bed.layer.size() == scene.species.size();
  std::vector<Expanded> all;
  for (std::size_t n = 0; n < scene.species.size(); ++n) {
    const Expanded& classes = all.emplace_back(expanded(scene.species[n], rule, scene.size_classes));
    for (std::size_t k = 0; k < classes.species.size(); ++k) {
      species.push_back(classes.species[k]);
      layer.push_back(layer_fits ? bed.layer[n] : std::int64_t(n + 1));
      if (shares_fit) shares.push_back(bed.volume_share[n] * classes.share[k]);
    }
  }
  expand_layers(scene.layers, scene.species, all);
  scene.feeds = expanded_feeds(scene.feeds, scene.size_classes);
  scene.contact_pairs = expanded_pairs(scene.contact_pairs, scene.size_classes);
  scene.species = std::move(species);
  if (shares_fit) bed.volume_share = std::move(shares);
  if (bed.start.kind == StartKind::layered && scene.layers.empty() && (layer_fits || bed.layer.empty()))
    bed.layer = std::move(layer);
}

}  // namespace polybed::core
