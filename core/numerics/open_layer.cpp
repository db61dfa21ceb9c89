#include "core/numerics/open_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace polybed::core {

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

namespace {

/// A cell with a smaller open share is merged with its neighbour: no small cell then limits a step, and the centre of
/// the open part lies inside the wall.
constexpr double least_volume = 0.5;

/// The limit for rings, which a sloping wall cuts anew in every layer: flow through a face that the wall closes turns
/// inwards within one layer and loses its momentum, three times as much with 0.5.
constexpr double least_volume_of_rings = 0.15;

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

}  // namespace

void Sections::add(double radius, double share, OpenLayer& layer) const {
  if (rings_)
    add_rings(in_cells(radius), share, layer);
  else
    add_disc(Disc(radius), share, layer);
}

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

}  // namespace polybed::core
