#include "core/case/layers.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>

#include "core/case/resolve.hpp"

namespace polybed::core {

namespace {

/// Axes of the column across which a layer is cut, in the order of its corners.
constexpr std::array<std::size_t, 2> across{0, 2};

/// Cross-section of a layer, without its solids.
BedPart footprint(const Scene& scene, const Layer& layer) {
  BedPart part;
  for (std::size_t d = 0; d < std::min({layer.from.size(), layer.to.size(), across.size()}); ++d) {
    const double size = scene.column.size[across[d]];
    part.from[d] = layer.from[d] / size;
    part.to[d] = std::min(layer.to[d] / size, 1.0);
  }
  return part;
}

double settled_fraction_of(const Scene& scene, const Layer& layer) {
  return layer.solids_fraction.value_or(scene.bed.solids_fraction);
}

/// Height of a layer in a uniform column; in a tapered one layers are as wide as the column.
double even_height_of(const Scene& scene, std::size_t n) {
  double low = 0;
  for (std::size_t m = 0; m < n && scene.column.is_tapered(); ++m) low += scene.layers[m].height;
  return scene.column.even_height(low + scene.layers[n].height) - scene.column.even_height(low);
}

std::vector<double> solids_of(const Scene& scene, std::size_t n) {
  const Layer& layer = scene.layers[n];
  std::vector<double> solids = layer.volume_share;
  for (double& one : solids) one *= even_height_of(scene, n) * settled_fraction_of(scene, layer);
  return solids;
}

/// Volume of each species over the cross-section of the column, m.
std::vector<double> solids_of_bed(const Scene& scene) {
  const Bed& bed = scene.bed;
  std::vector<double> solids;
  for (std::size_t j = 0; j < scene.species.size(); ++j)
    solids.push_back(bed.particles.empty()
                         ? bed.volume_share[j] * scene.column.even_height(bed.static_height) * bed.solids_fraction
                         : volume_of(bed.particles[j], scene.species[j]) / scene.column.cross_section());
  return solids;
}

/// The species of each part of a bed without [[layer]], from the bottom.
std::vector<std::vector<std::size_t>> groups_of(const Scene& scene) {
  const std::size_t species = scene.species.size();
  const bool layered = scene.bed.start.kind == StartKind::layered, numbered = scene.bed.layer.size() == species;
  std::map<std::int64_t, std::vector<std::size_t>> groups;
  for (std::size_t j = 0; j < species; ++j)
    groups[!layered ? 0 : (numbered ? scene.bed.layer[j] : std::int64_t(j))].push_back(j);
  std::vector<std::vector<std::size_t>> from_below;
  for (auto& [number, members] : groups) from_below.push_back(std::move(members));
  return from_below;
}

std::vector<BedPart> parts_of_layers(const Scene& scene) {
  std::vector<BedPart> parts;
  for (std::size_t n = 0; n < scene.layers.size(); ++n) {
    const Layer& layer = scene.layers[n];
    parts.push_back(footprint(scene, layer));
    parts.back().solids = solids_of(scene, n);
    const double settled = settled_fraction_of(scene, layer);
    parts.back().solids_fraction = std::min(settled, scene.bed.start_fraction.value_or(settled));
  }
  return parts;
}

/// Common area of two parts, as a share of the cross-section of the column; nothing if they touch up to round-off, as
/// with 12.5 mm and 0.0125 m.
double common_area(const BedPart& a, const BedPart& b) {
  constexpr double touching = 1e-9;
  double area = 1;
  for (std::size_t d = 0; d < across.size(); ++d) {
    const double overlap = std::min(a.to[d], b.to[d]) - std::max(a.from[d], b.from[d]);
    area *= overlap > touching ? overlap : 0;
  }
  return area;
}

}  // namespace

double BedPart::all_solids() const { return std::accumulate(solids.begin(), solids.end(), 0.0); }

std::vector<BedPart> start_parts(const Scene& scene) {
  const StartKind start = scene.bed.start.kind;
  if (!scene.layers.empty() && (start == StartKind::layered || start == StartKind::checkpoint))
    return parts_of_layers(scene);
  const std::vector<double> solids = solids_of_bed(scene);
  std::vector<BedPart> parts;
  for (const std::vector<std::size_t>& members : groups_of(scene)) {
    BedPart& part = parts.emplace_back();
    part.solids.assign(solids.size(), 0.0);
    for (const std::size_t j : members) part.solids[j] = solids[j];
    part.solids_fraction = scene.bed.start_solids_fraction;
  }
  return parts;
}

std::vector<Extent> stacked(const std::vector<BedPart>& parts, const std::vector<double>& height) {
  std::vector<Extent> extents;
  for (std::size_t n = 0; n < parts.size(); ++n) {
    double low = 0;
    for (std::size_t m = 0; m < n; ++m)
      if (common_area(parts[m], parts[n]) > 0) low = std::max(low, extents[m].high);
    extents.push_back({low, low + height[n]});
  }
  return extents;
}

std::vector<Extent> stacked(const std::vector<BedPart>& parts, const Column& column) {
  std::vector<double> height;
  for (const BedPart& part : parts) height.push_back(part.all_solids() / part.solids_fraction);
  std::vector<Extent> extents = stacked(parts, height);
  for (Extent& one : extents) one = {column.filled_height(one.low), column.filled_height(one.high)};
  return extents;
}

double top_of(const std::vector<Extent>& extents) {
  double top = 0;
  for (const Extent& one : extents) top = std::max(top, one.high);
  return top;
}

double supported_share(const std::vector<BedPart>& parts, const std::vector<Extent>& extents, std::size_t n) {
  constexpr double as_high = 1 - 1e-9;
  if (extents[n].low == 0) return 1;
  double area = 0;
  for (std::size_t m = 0; m < n; ++m)
    if (extents[m].high >= as_high * extents[n].low) area += common_area(parts[m], parts[n]);
  return area / parts[n].area();
}

LayerTotals totals_of_layers(const Scene& scene) {
  LayerTotals totals;
  totals.share.assign(scene.species.size(), 0.0);
  for (std::size_t n = 0; n < scene.layers.size(); ++n) {
    const std::vector<double> solids = solids_of(scene, n);
    const double area = footprint(scene, scene.layers[n]).area();
    for (std::size_t j = 0; j < totals.share.size(); ++j) totals.share[j] += area * solids[j];
  }
  totals.solids = std::accumulate(totals.share.begin(), totals.share.end(), 0.0);
  for (double& share : totals.share) share /= totals.solids;
  return totals;
}

SettledFractions settled_fractions(const Scene& scene) {
  SettledFractions settled{scene.bed.solids_fraction,
                           std::vector<double>(scene.species.size(), scene.bed.solids_fraction)};
  if (scene.layers.empty()) return settled;
  std::vector<double> solids(scene.species.size(), 0.0), bulk = solids;
  for (std::size_t n = 0; n < scene.layers.size(); ++n) {
    const std::vector<double> here = solids_of(scene, n);
    const double area = footprint(scene, scene.layers[n]).area();
    for (std::size_t j = 0; j < std::min(here.size(), solids.size()); ++j) {
      solids[j] += area * here[j];
      bulk[j] += area * here[j] / settled_fraction_of(scene, scene.layers[n]);
    }
  }
  const auto sum = [](const std::vector<double>& parts) { return std::accumulate(parts.begin(), parts.end(), 0.0); };
  if (sum(bulk) > 0) settled.of_bed = sum(solids) / sum(bulk);
  for (std::size_t j = 0; j < solids.size(); ++j)
    if (bulk[j] > 0) settled.of_species[j] = solids[j] / bulk[j];
  return settled;
}

double loosest_settled(const Scene& scene) {
  double loosest = scene.bed.solids_fraction;
  for (const Layer& layer : scene.layers) loosest = std::min(loosest, settled_fraction_of(scene, layer));
  return loosest;
}

void fill_layers(Scene& scene) {
  Bed& bed = scene.bed;
  double densest = 0;
  for (Layer& layer : scene.layers) {
    if (layer.volume_share.empty())
      for (const Species& species : scene.species) layer.volume_share.push_back(species.name == layer.species ? 1 : 0);
    layer.species.clear();
    layer.solids_fraction = settled_fraction_of(scene, layer);
    densest = std::max(densest, *layer.solids_fraction);
  }
  if (!(bed.solids_fraction > 0)) bed.solids_fraction = densest;
  const LayerTotals totals = totals_of_layers(scene);
  if (bed.volume_share.empty()) bed.volume_share = totals.share;
  if (!(bed.static_height > 0)) bed.static_height = scene.column.filled_height(totals.solids / bed.solids_fraction);
}

}  // namespace polybed::core
