// Longer than 400 lines because all columns, with their tapers and ducts, are built from the same cut cells.
#include "core/numerics/cross_sections.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace polybed::core {

namespace {

/// Places up to this share of a cell beyond its face are round-off.
constexpr double near_face = 1e-9;

/// Area of a disc about the origin with X <= x and Z <= z.
class Disc {
 public:
  explicit Disc(double radius) : radius_(radius) {}

  [[nodiscard]] double below(double x, double z) const {
    x = std::clamp(x, -radius_, radius_);
    z = std::clamp(z, -radius_, radius_);
    return z < 0 ? half(x) - capped(x, -z) : half(x) + capped(x, z);
  }
  /// Length of the chord at a distance from the centre, between two places on it.
  [[nodiscard]] double chord(double distance, double from, double to) const {
    const double reach = radius_ * radius_ - distance * distance;
    if (!(reach > 0)) return 0;
    const double most = std::sqrt(reach);
    return std::max(0.0, std::min(to, most) - std::max(from, -most));
  }

 private:
  /// Integral of sqrt(R^2 - t^2) from -R to x.
  [[nodiscard]] double half(double x) const {
    const double inside = std::max(radius_ * radius_ - x * x, 0.0);
    return 0.5 * (x * std::sqrt(inside) + radius_ * radius_ * (std::asin(x / radius_) + 0.5 * std::numbers::pi));
  }
  /// The integral of min(h, sqrt(R^2 - t^2)).
  [[nodiscard]] double capped(double x, double h) const {
    const double w = std::sqrt(std::max(radius_ * radius_ - h * h, 0.0));
    if (x <= -w) return half(x);
    if (x <= w) return half(-w) + h * (x + w);
    return half(-w) + 2 * h * w + (half(x) - half(w));
  }

  double radius_;
};

/// A cell with a smaller open share is merged with its neighbour: no small cell then limits a step, and the centre of
/// the open part lies inside the wall.
constexpr double least_volume = 0.5;

/// The limit for rings, which a sloping wall cuts anew in every layer: flow through a face that the wall closes turns
/// inwards within one layer and loses its momentum, three times as much with 0.5.
constexpr double least_volume_of_rings = 0.15;

/// The neighbour that a cell was merged into.
struct Taken {
  std::size_t from;
  std::vector<std::size_t> to;
};

/// A layer of the column under construction.
struct OpenLayer {
  CrossSection open;
  std::vector<double> around;  ///< rings: outward push of an even pressure on a cell, in faces along x
  std::vector<Taken> taken;    ///< from the outside in
};

/// Builds the grid of a column about its axis.
class Sections {
 public:
  Sections(const Grid& column, bool rings)
      : rings_(rings),
        nx_(column.cells[0]),
        nz_(column.cells[2]),
        hx_(column.spacing[0]),
        hz_(column.spacing[2]),
        hy_(column.spacing[1]),
        radius_(rings ? nx_ * hx_ : 0.5 * nx_ * hx_) {}

  /// Adds a share of the area within a radius of the axis.
  void add(double radius, double share, OpenLayer& layer) const {
    if (rings_)
      add_rings(in_cells(radius), share, layer);
    else
      add_disc(Disc(radius), share, layer);
  }
  [[nodiscard]] OpenLayer empty() const {
    const auto cells = std::size_t(nx_ * nz_);
    OpenLayer layer{
        {nx_, nz_, std::vector<double>(cells), {}, std::vector<double>(std::size_t((nx_ + 1) * nz_)), {}, {}, {}},
        std::vector<double>(cells),
        {}};
    if (!rings_) layer.open.open_z.resize(std::size_t(nx_ * (nz_ + 1)));
    for (int i = 0; rings_ && i <= nx_; ++i) layer.open.radius.push_back(i * hx_);
    return layer;
  }
  /// Opens the cells of a duct, from the side to where they are whole, and marks them.
  void open_duct(const Duct& duct, OpenLayer& layer, std::vector<bool>& in_duct) const;
  /// Merges a small cell with the neighbour across its largest face, or in equal parts with two alike.
  void absorb_small_cells(OpenLayer& layer) const;
  /// Sets the wall of a layer with the open shares `below` at its low faces and `above` at its high ones.
  void set_wall(const std::vector<double>& below, const std::vector<double>& above, const Taper& taper, double height,
                OpenLayer& layer) const;
  [[nodiscard]] double radius() const { return radius_; }
  /// Radii at which the open part of a cell or face begins and ends.
  [[nodiscard]] std::vector<double> steps() const {
    std::vector<double> radii;
    for (int i = 0; rings_ && i <= nx_; ++i) radii.push_back(i * hx_);
    return radii;
  }

 private:
  /// A radius that equals a face's up to round-off becomes that face's.
  [[nodiscard]] double in_cells(double radius) const {
    const double cells = radius / hx_, face = std::round(cells);
    return std::abs(cells - face) < 1e-14 * nx_ ? face : cells;
  }
  [[nodiscard]] double x(int i) const { return i * hx_ - (rings_ ? 0 : radius_); }
  [[nodiscard]] double z(int k) const { return k * hz_ - radius_; }
  [[nodiscard]] double from_axis(int i, int k) const {
    const double along_x = x(i) + 0.5 * hx_;
    return rings_ ? along_x : std::hypot(along_x, z(k) + 0.5 * hz_);
  }
  /// Volume of a whole cell.
  [[nodiscard]] double whole(int i) const { return rings_ ? (2.0 * i + 1) / nx_ : 1.0; }

  void add_disc(const Disc& disc, double share, OpenLayer& layer) const;
  /// \param radius  in cells
  void add_rings(double radius, double share, OpenLayer& layer) const;
  void absorb(int i, int k, OpenLayer& layer) const;

  bool rings_;
  int nx_, nz_;
  double hx_, hz_, hy_, radius_;
};

void Sections::add_disc(const Disc& disc, double share, OpenLayer& layer) const {
  CrossSection& open = layer.open;
  std::vector<double> corners;
  for (int k = 0; k <= nz_; ++k)
    for (int i = 0; i <= nx_; ++i) corners.push_back(disc.below(x(i), z(k)));
  const auto below = [&](int i, int k) { return corners[std::size_t(i + (nx_ + 1) * k)]; };
  for (int k = 0; k < nz_; ++k)
    for (int i = 0; i < nx_; ++i)
      open.volume_of(i, k) +=
          share * ((below(i + 1, k + 1) - below(i, k + 1)) - (below(i + 1, k) - below(i, k))) / (hx_ * hz_);
  for (int k = 0; k < nz_; ++k)
    for (int i = 0; i <= nx_; ++i) open.x_face(i, k) += share * disc.chord(x(i), z(k), z(k + 1)) / hz_;
  for (int k = 0; k <= nz_; ++k)
    for (int i = 0; i < nx_; ++i) open.z_face(i, k) += share * disc.chord(z(k), x(i), x(i + 1)) / hx_;
}

void Sections::add_rings(double radius, double share, OpenLayer& layer) const {
  for (int i = 0; i < nx_; ++i) {
    const double end = std::clamp(radius, double(i), i + 1.0);
    layer.open.volume_of(i, 0) += share * (end * end - double(i) * i) / nx_;
    layer.around[std::size_t(i)] += share * 2 * (end - i) / nx_;
  }
  for (int i = 0; i <= nx_; ++i)
    if (radius >= i) layer.open.x_face(i, 0) += share * 2.0 * i / nx_;
}

void Sections::open_duct(const Duct& duct, OpenLayer& layer, std::vector<bool>& in_duct) const {
  CrossSection& open = layer.open;
  const bool along_x = duct.axis == 0;
  const int rows = along_x ? nz_ : nx_, length = along_x ? nx_ : nz_;
  const double h = along_x ? hz_ : hx_;
  for (int row = 0; row < rows; ++row) {
    if (std::min(duct.to[0], (row + 1) * h) - std::max(duct.from[0], row * h) < near_face * h) continue;
    for (int n = 0; n < length; ++n) {
      const int cell = duct.side == 0 ? n : length - 1 - n, face = duct.side == 0 ? cell : cell + 1;
      const int i = along_x ? cell : row, k = along_x ? row : cell;
      (along_x ? open.x_face(face, k) : open.z_face(i, face)) = 1;
      if (open.volume_of(i, k) > 1 - near_face && !in_duct[open.at(i, k)]) break;
      open.volume_of(i, k) = 1;
      in_duct[open.at(i, k)] = true;
    }
  }
  const auto both = [&](int i, int k, int x, int z) { return in_duct[open.at(i, k)] && in_duct[open.at(x, z)]; };
  for (int k = 0; k < nz_; ++k)
    for (int i = 0; i < nx_; ++i) {
      if (i > 0 && both(i, k, i - 1, k)) open.x_face(i, k) = 1;
      if (k > 0 && both(i, k, i, k - 1)) open.z_face(i, k) = 1;
    }
}

void Sections::absorb(int i, int k, OpenLayer& layer) const {
  struct Side {
    double* open;
    int i, k;
  };
  CrossSection& section = layer.open;
  std::vector<Side> sides{{&section.x_face(i, k), i - 1, k}};
  if (i + 1 < nx_ || !rings_) sides.push_back({&section.x_face(i + 1, k), i + 1, k});
  if (!rings_) {
    sides.push_back({&section.z_face(i, k), i, k - 1});
    sides.push_back({&section.z_face(i, k + 1), i, k + 1});
  }
  double most = 0;
  for (const Side& side : sides) most = std::max(most, *side.open);
  const auto alike = [most](const Side& side) { return *side.open > 0 && *side.open > (1 - 1e-9) * most; };
  const auto takers = double(std::count_if(sides.begin(), sides.end(), alike));
  Taken taken{section.at(i, k), {}};
  for (const Side& side : sides)
    if (alike(side)) {
      const std::size_t to = section.at(side.i, side.k);
      section.volume[to] += section.volume[taken.from] / takers;
      layer.around[to] += layer.around[taken.from] / takers;
      taken.to.push_back(to);
    }
  for (const Side& side : sides) *side.open = 0;
  section.volume[taken.from] = layer.around[taken.from] = 0;
  layer.taken.push_back(std::move(taken));
}

/// Works from the outside in, so that a cell merged into a small cell moves on with it.
void Sections::absorb_small_cells(OpenLayer& layer) const {
  std::vector<std::array<int, 3>> cells;  // distance from the centre in half cells, squared; i; k
  const double least = rings_ ? least_volume_of_rings : least_volume;
  const auto is_small = [&](int i, int k) { return layer.open.volume_of(i, k) < least * whole(i); };
  for (int k = 0; k < nz_; ++k)
    for (int i = 0; i < nx_; ++i) {
      const int x = 2 * i + 1 - (rings_ ? 0 : nx_), z = 2 * k + 1 - nz_;
      if (is_small(i, k)) cells.push_back({-(x * x + z * z), i, k});
    }
  std::sort(cells.begin(), cells.end());
  for (const auto& [distance, i, k] : cells)
    if (is_small(i, k)) absorb(i, k, layer);
  for (int i = 1; rings_ && i <= nx_; ++i)  // along a wall that follows a face
    if (layer.open.volume_of(std::min(i, nx_ - 1), 0) == 0) layer.open.x_face(i, 0) = 0;
}

/// Distance of a place from a wall, m; 0 beyond it.
double distance_from(const Taper& taper, double radius, double height) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t n = 1; n < taper.size(); ++n) {
    const double y0 = taper[n - 1].first, r0 = 0.5 * taper[n - 1].second, along_y = taper[n].first - y0,
                 along_r = 0.5 * taper[n].second - r0, length = along_y * along_y + along_r * along_r;
    if (!(length > 0)) continue;
    const double at = ((height - y0) * along_y + (radius - r0) * along_r) / length;
    if (along_y > 0 && height >= y0 && height <= taper[n].first && radius > r0 + along_r * (height - y0) / along_y)
      return 0;
    const double share = std::clamp(at, 0.0, 1.0);
    least = std::min(least, std::hypot(height - y0 - share * along_y, radius - r0 - share * along_r));
  }
  return least;
}

// The areas of a cell's faces, its wall included, sum to zero, except for the curvature of a ring.
void Sections::set_wall(const std::vector<double>& below, const std::vector<double>& above, const Taper& taper,
                        double height, OpenLayer& layer) const {
  CrossSection& section = layer.open;
  const double least = rings_ ? std::min(hx_, hy_) : taper.empty() ? std::min(hx_, hz_) : std::min({hx_, hy_, hz_});
  section.wall.assign(section.volume.size(), 0.0);
  for (int k = 0; k < nz_; ++k)
    for (int i = 0; i < nx_; ++i) {
      const std::size_t at = section.at(i, k);
      const double theta = section.volume[at];
      const double to_x = section.x_face(i, k) - section.x_face(i + 1, k) + layer.around[at];
      const double to_z = rings_ ? 0 : section.z_face(i, k) - section.z_face(i, k + 1);
      const double across = std::hypot(to_x / hx_, to_z / hz_);  // over the whole cell's volume, 1/m
      const double area = taper.empty() ? across : std::hypot(across, (above[at] - below[at]) / hy_);
      if (!(theta > 0) || area * least < 1e-9) continue;
      double to_wall = taper.empty() ? radius_ - from_axis(i, k) : distance_from(taper, from_axis(i, k), height);
      if (rings_) to_wall = std::max(to_wall, 0.5 * theta / area);         // half the thickness of the open part
      section.wall[at] = area / (std::max(to_wall, 0.1 * least) * theta);  // or it would limit the step
    }
}

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

/// Open shares of the faces between two layers, null beyond the ends. The shares of closed cells move with their
/// volume, so that the whole cross-section stays open.
std::vector<double> level_between(const Sections& sections, double radius, const OpenLayer* below,
                                  const OpenLayer* above) {
  OpenLayer level = sections.empty();
  sections.add(radius, 1, level);
  std::vector<double>& open = level.open.volume;
  const double all = std::accumulate(open.begin(), open.end(), 0.0);
  const auto is_closed = [&](std::size_t c) {
    return (below && !(below->open.volume[c] > 0)) || (above && !(above->open.volume[c] > 0));
  };
  const auto is_left = [&] {
    for (std::size_t c = 0; c < open.size(); ++c)
      if (open[c] > 0 && is_closed(c)) return true;
    return false;
  };
  for (int pass = 0; pass < level.open.width && is_left(); ++pass)
    for (const OpenLayer* layer : {below, above})
      for (std::size_t n = 0; layer && n < layer->taken.size(); ++n) {
        const Taken& taken = layer->taken[n];
        for (const std::size_t to : taken.to) open[to] += open[taken.from] / double(taken.to.size());
        open[taken.from] = 0;
      }
  for (std::size_t c = 0; c < open.size(); ++c)
    if (is_closed(c)) open[c] = 0;
  const double left = std::accumulate(open.begin(), open.end(), 0.0);
  for (double& share : open) share *= all / left;
  return open;
}

using Chosen = std::vector<std::size_t>;  ///< ducts, by number, in order

CrossSection section_with_ducts(const Sections& sections, const Ducts& ducts, const Chosen& chosen) {
  OpenLayer layer = sections.empty();
  sections.add(sections.radius(), 1, layer);
  std::vector<bool> in_duct(layer.open.volume.size(), false);
  for (const std::size_t n : chosen) sections.open_duct(ducts[n], layer, in_duct);
  sections.absorb_small_cells(layer);
  layer.open.open_y = layer.open.volume;
  sections.set_wall(layer.open.open_y, layer.open.open_y, {}, 0, layer);
  for (std::size_t c = 0; c < in_duct.size(); ++c)  // a duct is short: it has no friction
    if (in_duct[c]) layer.open.wall[c] = 0;
  return std::move(layer.open);
}

/// Open shares of faces that lie between two layers: those of the circle, without the cells that one of both closes. A
/// duct that is several layers high is no shaft beside the column.
std::vector<double> level_with_ducts(const CrossSection& circle, const CrossSection& below, const CrossSection& above) {
  std::vector<double> open = circle.volume;
  const double all = std::accumulate(open.begin(), open.end(), 0.0);
  for (std::size_t c = 0; c < open.size(); ++c)
    if (!(below.volume[c] > 0 && above.volume[c] > 0)) open[c] = 0;
  const double left = std::accumulate(open.begin(), open.end(), 0.0);
  for (double& share : open) share *= all / left;
  return open;
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

std::vector<CrossSection> cross_sections(const Grid& column, bool rings, const Taper& taper) {
  const Sections sections(column, rings);
  const auto level_of = [&](std::size_t y) {  // heights that agree up to round-off are one step
    const double h = column.spacing[1], height = double(y) * h;
    const auto row = std::find_if(taper.begin(), taper.end(),
                                  [&](const auto& one) { return std::abs(one.first - height) < 1e-11 * h; });
    return row == taper.end() ? height : row->first;
  };
  const auto count = std::size_t(taper.empty() ? 1 : column.cells[1]);
  std::vector<OpenLayer> layers;
  for (std::size_t n = 0; n < count; ++n) {
    layers.push_back(taper.empty() ? sections.empty() : layer_between(sections, taper, level_of(n), level_of(n + 1)));
    if (taper.empty()) sections.add(sections.radius(), 1, layers.back());
    sections.absorb_small_cells(layers.back());
  }
  std::vector<CrossSection> result;
  if (taper.empty()) {
    OpenLayer& only = layers.front();
    only.open.open_y = only.open.volume;
    sections.set_wall(only.open.open_y, only.open.open_y, taper, 0, only);
    return {std::move(only.open)};
  }
  for (std::size_t n = 0; n <= count; ++n) {
    const double height = level_of(n);
    const double radius = std::min(n > 0 ? radius_at(taper, height, -1) : radius_at(taper, height, 1),
                                   n < count ? radius_at(taper, height, 1) : radius_at(taper, height, -1));
    result.push_back(n < count ? layers[n].open : sections.empty().open);
    result.back().open_y =
        level_between(sections, radius, n > 0 ? &layers[n - 1] : nullptr, n < count ? &layers[n] : nullptr);
  }
  for (std::size_t n = 0; n < count; ++n) {
    sections.set_wall(result[n].open_y, result[n + 1].open_y, taper, (double(n) + 0.5) * column.spacing[1], layers[n]);
    result[n].wall = std::move(layers[n].open.wall);
  }
  return result;
}

std::vector<CrossSection> cross_sections_with_ducts(const Grid& column, const Ducts& ducts) {
  const Sections sections(column, false);
  std::map<Chosen, CrossSection> built;
  const auto section = [&](const Chosen& chosen) -> const CrossSection& {
    const auto known = built.find(chosen);
    return known != built.end() ? known->second
                                : built.emplace(chosen, section_with_ducts(sections, ducts, chosen)).first->second;
  };
  std::vector<Chosen> chosen{{}};  // those at each layer, from the one below the bottom to the one above the top
  for (int y = 0; y < column.cells[1]; ++y) {
    chosen.emplace_back();
    for (std::size_t n = 0; n < ducts.size(); ++n)
      if (std::min(ducts[n].to[1], column.low(1, y + 1)) - std::max(ducts[n].from[1], column.low(1, y)) >=
          near_face * column.height(y))
        chosen.back().push_back(n);
  }
  chosen.emplace_back();
  std::vector<CrossSection> result;
  for (std::size_t n = 1; n < chosen.size(); ++n) {
    result.push_back(section(chosen[n]));
    result.back().open_y = level_with_ducts(section({}), section(chosen[n - 1]), section(chosen[n]));
  }
  return result;
}

}  // namespace polybed::core
