#include "core/numerics/cross_sections.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/numerics/open_layer.hpp"

namespace polybed::core {

namespace {

/// Heights from `low` to `high` between which the wall is straight and crosses no step of the grid.
std::vector<double> straight_parts(const Taper& taper, const std::vector<double>& steps, double low, double high) {
  std::vector<double> heights{low, high};
  for (std::size_t n = 1; n < taper.size(); ++n) {
    const double y0 = taper[n - 1].first, y1 = taper[n].first, r0 = 0.5 * taper[n - 1].second,
                 r1 = 0.5 * taper[n].second;
    heights.push_back(y1);
    for (const double r : steps)
      if ((r - r0) * (r - r1) < 0) heights.push_back(y0 + (y1 - y0) * (r - r0) / (r1 - r0));
  }
  std::erase_if(heights, [&](double y) { return y < low || y > high; });
  std::sort(heights.begin(), heights.end());
  return heights;
}

/// Gauss's five points between 0 and 1: areas are quadratic in height.
constexpr std::array<double, 5> gauss_at{0.046910077030668004, 0.23076534494715845, 0.5, 0.76923465505284155,
                                         0.95308992296933200};
constexpr std::array<double, 5> gauss_weight{0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                             0.23931433524968324, 0.11846344252809454};

/// The mean layer between two heights.
OpenLayer layer_between(const Sections& sections, const Taper& taper, double low, double high) {
  OpenLayer layer = sections.empty();
  const std::vector<double> heights = straight_parts(taper, sections.steps(), low, high);
  for (std::size_t n = 1; n < heights.size(); ++n) {
    const double y0 = heights[n - 1], y1 = heights[n];
    if (!(y1 - y0 > 1e-12 * (high - low))) continue;
    const double r0 = radius_at(taper, y0, 1), r1 = radius_at(taper, y1, -1);
    for (std::size_t g = 0; g < gauss_at.size(); ++g)
      sections.add(r0 + gauss_at[g] * (r1 - r0), gauss_weight[g] * (y1 - y0) / (high - low), layer);
  }
  return layer;
}

/// Open shares of the faces between two layers. The shares of closed cells move with their
/// volume, so that the whole cross-section stays open.
std::vector<double> level_between(const Sections& sections, double radius, const OpenLayer& below,
                                  const OpenLayer& above) {
  OpenLayer level = sections.empty();
  sections.add(radius, 1, level);
  std::vector<double>& open = level.open.volume;
  const double all = std::accumulate(open.begin(), open.end(), 0.0);
  const auto is_closed = [&](std::size_t c) { return !(below.open.volume[c] > 0) || !(above.open.volume[c] > 0); };
  const auto is_left = [&] {
    for (std::size_t c = 0; c < open.size(); ++c)
      if (open[c] > 0 && is_closed(c)) return true;
    return false;
  };
  for (int pass = 0; pass < level.open.width && is_left(); ++pass)
    for (const OpenLayer* layer : {&below, &above})
      for (const Taken& taken : layer->taken) {
        for (const std::size_t to : taken.to) open[to] += open[taken.from] / double(taken.to.size());
        open[taken.from] = 0;
      }
  for (std::size_t c = 0; c < open.size(); ++c)
    if (is_closed(c)) open[c] = 0;
  const double left = std::accumulate(open.begin(), open.end(), 0.0);
  for (double& share : open) share *= all / left;
  return open;
}

/// Opens the ducts that reach into layer y. A duct is short: it has no friction. \return the cells in ducts; empty:
/// none
std::vector<bool> open_ducts(const Sections& sections, const Grid& column, const Ducts& ducts, int y,
                             OpenLayer& layer) {
  std::vector<bool> in_duct;
  for (const Duct& duct : ducts) {
    if (std::min(duct.to[1], column.low(1, y + 1)) - std::max(duct.from[1], column.low(1, y)) <
        near_face * column.height(y))
      continue;
    in_duct.resize(layer.open.volume.size(), false);
    sections.open_duct(duct, layer, in_duct);
  }
  return in_duct;
}

}  // namespace

double radius_at(const Taper& taper, double height, int side) {
  for (std::size_t n = 1; n < taper.size(); ++n) {
    const auto& [y0, d0] = taper[n - 1];
    const auto& [y1, d1] = taper[n];
    const bool here = side > 0 ? height >= y0 && height < y1 : height > y0 && height <= y1;
    if (here) return 0.5 * (d0 + (d1 - d0) * (height - y0) / (y1 - y0));
  }
  return 0.5 * (height > taper.front().first ? taper.back() : taper.front()).second;
}

std::vector<CrossSection> cross_sections(const Grid& column, bool rings, const Taper& taper, const Ducts& ducts) {
  const Sections sections(column, rings);
  const auto level_of = [&](std::size_t y) {  // heights that agree up to round-off are one step
    const double h = column.spacing[1], height = double(y) * h;
    const auto row = std::find_if(taper.begin(), taper.end(),
                                  [&](const auto& one) { return std::abs(one.first - height) < 1e-11 * h; });
    return row == taper.end() ? height : row->first;
  };
  const bool alike = taper.empty() && ducts.empty();
  const auto count = std::size_t(alike ? 1 : column.cells[1]);
  const auto whole_layer = [&](std::size_t n) {
    OpenLayer layer = taper.empty() ? sections.empty() : layer_between(sections, taper, level_of(n), level_of(n + 1));
    if (taper.empty()) sections.add(sections.radius(), 1, layer);
    return layer;
  };
  std::vector<OpenLayer> layers;
  std::vector<std::vector<bool>> in_duct;
  for (std::size_t n = 0; n < count; ++n) {
    layers.push_back(whole_layer(n));
    in_duct.push_back(open_ducts(sections, column, ducts, int(n), layers.back()));
    sections.absorb_small_cells(layers.back());
  }
  if (alike) {
    OpenLayer& only = layers.front();
    only.open.open_y = only.open.volume;
    sections.set_wall(only.open.open_y, only.open.open_y, taper, 0, only);
    return {std::move(only.open)};
  }
  const auto radius_of = [&](std::size_t n) {
    if (taper.empty()) return sections.radius();
    const double height = level_of(n);
    return std::min(n > 0 ? radius_at(taper, height, -1) : radius_at(taper, height, 1),
                    n < count ? radius_at(taper, height, 1) : radius_at(taper, height, -1));
  };
  std::vector<OpenLayer> beyond;  // without ducts
  for (const std::size_t end : {std::size_t(0), count - 1}) {
    beyond.push_back(whole_layer(end));
    sections.absorb_small_cells(beyond.back());
  }
  std::vector<CrossSection> result;
  for (std::size_t n = 0; n <= count; ++n) {
    result.push_back(n < count ? layers[n].open : sections.empty().open);
    result.back().open_y = level_between(sections, radius_of(n), n > 0 ? layers[n - 1] : beyond.front(),
                                         n < count ? layers[n] : beyond.back());
  }
  for (std::size_t n = 0; n < count; ++n) {
    sections.set_wall(result[n].open_y, result[n + 1].open_y, taper, (double(n) + 0.5) * column.spacing[1], layers[n]);
    result[n].wall = std::move(layers[n].open.wall);
    for (std::size_t c = 0; c < in_duct[n].size(); ++c)
      if (in_duct[n][c]) result[n].wall[c] = 0;
  }
  return result;
}

}  // namespace polybed::core
