#include "core/numerics/inner_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.hpp"

namespace polybed::core {

InnerWalls::InnerWalls(std::span<const InnerWall> walls, const std::array<double, 3>& size, bool rings)
    : axis_x_(rings ? 0 : 0.5 * size[0]), axis_z_(0.5 * size[2]), rings_(rings) {
  for (std::size_t n = 0; n < walls.size(); ++n) {
    const InnerWall& wall = walls[n];
    if (!(wall.thickness > 0)) continue;
    const double across = wall.is_round() ? 0.5 : 1.0;  // a round wall gives diameters
    WallProfile profile(across * wall.from[0], wall.from[1], across * wall.to[0], wall.to[1]);
    profile.half = 0.5 * wall.thickness;
    parts_.push_back({profile, wall.is_round(), n});
  }
}

InnerWalls::Found InnerWalls::find(const std::array<double, 3>& place) const {
  const double dx = place[0] - axis_x_, dz = rings_ ? 0 : place[2] - axis_z_;
  Found found;
  found.radius = std::sqrt(dx * dx + dz * dz);
  for (const Part& part : parts_) {
    const double distance = part.profile.gap({part.round ? found.radius : place[0], place[1]});
    if (distance >= found.distance) continue;
    found.part = &part;
    found.distance = distance;
  }
  return found;
}

FromWall InnerWalls::nearest(const std::array<double, 3>& place) const {
  const Found found = find(place);
  if (found.part == nullptr) return {found.distance, {0, 1, 0}};
  const WallProfile& profile = found.part->profile;
  const InPlane away = profile.from_middle({found.part->round ? found.radius : place[0], place[1]});
  const double length = std::sqrt(away[0] * away[0] + away[1] * away[1]), radius = found.radius;
  const double across = length > 0 ? away[0] / length : 0, up = length > 0 ? away[1] / length : 1;
  const bool turned = found.part->round && radius > 0;
  return {found.distance,
          {turned ? across * (place[0] - axis_x_) / radius : across, up,
           turned && !rings_ ? across * (place[2] - axis_z_) / radius : 0},
          found.part->wall};
}

// Volume under a plane in a box, by inclusion and exclusion of its corners (Scardovelli and Zaleski 2000, J. Comput.
// Phys. 164, 228, eq. 3), with the box's widths along the normal as m: sum over corners (-1)^n max(d - m.corner, 0)^k /
// (k! prod m). Widths below 1e-4 of the greatest are left out, which moves the plane by their half.
double share_beyond(double distance, const std::array<double, 3>& along, const std::array<double, 3>& w) {
  std::array<double, 3> m{};
  double all = 0, most = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    m[a] = std::abs(along[a]) * w[a];
    all += m[a];
    most = std::max(most, m[a]);
  }
  if (distance >= 0.5 * all * (1 - 1e-12)) return 1;
  if (distance <= -0.5 * all * (1 - 1e-12)) return 0;
  std::array<double, 3> kept{};
  std::size_t count = 0;
  double sum = 0, scale = 1;
  for (const double one : m)
    if (one > 1e-4 * most) {
      kept[count++] = one;
      sum += one;
      scale *= one * double(count);
    }
  const double depth = distance + 0.5 * sum;
  double volume = 0;
  for (std::size_t corner = 0; corner < (std::size_t(1) << count); ++corner) {
    double above = depth, sign = 1;
    for (std::size_t n = 0; n < count; ++n)
      if ((corner >> n & 1) != 0) {
        above -= kept[n];
        sign = -sign;
      }
    for (std::size_t n = 0; above > 0 && n < count; ++n) sign *= above;
    if (above > 0) volume += sign;
  }
  return std::clamp(volume / scale, 0.0, 1.0);
}

namespace {

/// A cell that is less open is merged with its neighbour, as in round columns; faces that are less open are closed.
constexpr double least_cell = 0.5, least_face = 0.02;
constexpr int halvings = 3;  ///< of a cut cell or face along each axis, into parts that are each cut by a plane

using Cell = std::array<int, 3>;
using Place = std::array<double, 3>;

/// The layers of a column as one field.
class Cutting {
 public:
  Cutting(const Grid& column, const InnerWalls& walls, bool rings, std::vector<CrossSection>& layers)
      : walls_(walls), h_(column.spacing), n_(column.cells), axes_(column.dimensions), rings_(rings), layers_(layers) {}

  void cut();
  void merge_small_cells();
  void close_what_is_cut_off();
  /// Sets friction of the walls, from the areas that they have taken from the faces since the other layers.
  void set_friction(const std::vector<CrossSection>& before);

 private:
  [[nodiscard]] std::size_t at(const Cell& c) const {
    return std::size_t(c[0]) + std::size_t(n_[0]) * std::size_t(c[2]);
  }
  [[nodiscard]] static Cell next(Cell c, int axis, int step) {
    c[std::size_t(axis)] += step;
    return c;
  }
  [[nodiscard]] bool inside(const Cell& c) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (c[a] < 0 || c[a] >= n_[a]) return false;
    return true;
  }
  [[nodiscard]] double& volume(const Cell& c) const { return layers_[std::size_t(c[1])].volume[at(c)]; }
  /// The low face of a cell along an axis; the cell may be one beyond the last.
  [[nodiscard]] double& face(const Cell& c, int axis) const {
    CrossSection& section = layers_[std::size_t(c[1])];
    if (axis == 1) return section.open_y[at(c)];
    return axis == 0 ? section.x_face(c[0], c[2]) : section.z_face(c[0], c[2]);
  }
  [[nodiscard]] static double face_in(const std::vector<CrossSection>& layers, const Cell& c, int axis) {
    return layers[std::size_t(c[1])].face(axis, c[0], c[2]);
  }
  [[nodiscard]] double& side_face(const Cell& c, int axis, int side) const { return face(next(c, axis, side), axis); }
  [[nodiscard]] double whole(const Cell& c) const { return rings_ ? (2.0 * c[0] + 1) / n_[0] : 1.0; }
  [[nodiscard]] Place centre(const Cell& c) const {
    return {(c[0] + 0.5) * h_[0], (c[1] + 0.5) * h_[1], (c[2] + 0.5) * h_[2]};
  }
  [[nodiscard]] double open_share(const Place& middle, const Place& widths) const;
  [[nodiscard]] double open_part(const Place& middle, const Place& widths, int halvings) const;
  void absorb(const Cell& c);
  [[nodiscard]] std::size_t number(const Cell& c) const {
    return at(c) + std::size_t(n_[0]) * std::size_t(n_[2]) * std::size_t(c[1]);
  }
  /// Whether a cell is to be merged, or lies beyond the column.
  [[nodiscard]] bool is_small(const Cell& c) const { return !inside(c) || small_[number(c)]; }
  void close(const Cell& c) {
    volume(c) = 0;
    for (int axis = 0; axis < axes_; ++axis)
      for (const int side : {0, 1}) side_face(c, axis, side) = 0;
  }
  template <class Body>
  void for_each_cell(Body&& body) const {
    for (int j = 0; j < n_[1]; ++j)
      for (int k = 0; k < n_[2]; ++k)
        for (int i = 0; i < n_[0]; ++i) body(Cell{i, j, k});
  }
  /// Calls body(neighbour, common face) for the neighbours in the column.
  template <class Body>
  void for_each_neighbour(const Cell& c, Body&& body) const {
    for (int axis = 0; axis < axes_; ++axis)
      for (const int side : {0, 1})
        if (const Cell other = next(c, axis, 2 * side - 1); inside(other)) body(other, axis, side);
  }

  const InnerWalls& walls_;
  Place h_;
  Cell n_;
  int axes_;
  bool rings_;
  std::vector<CrossSection>& layers_;
  std::vector<bool> small_;
};

/// Open share of a box or, with one width of 0, of a face; in rings weighted with the radius.
double Cutting::open_share(const Place& middle, const Place& widths) const {
  Place width = widths;
  for (std::size_t a = std::size_t(axes_); a < 3; ++a) width[a] = 0;
  const double share = open_part(middle, width, halvings) / (rings_ && widths[0] > 0 ? middle[0] : 1);
  constexpr double round_off = 1e-9;
  return share < round_off ? 0 : (share > 1 - round_off ? 1 : share);
}

/// The same times the radius of the middle of a cell in rings.
double Cutting::open_part(const Place& middle, const Place& widths, int left) const {
  const double distance = walls_.distance(middle), weight = rings_ && widths[0] > 0 ? middle[0] : 1;
  const double half = 0.5 * std::sqrt(widths[0] * widths[0] + widths[1] * widths[1] + widths[2] * widths[2]);
  if (distance >= half) return weight;
  if (distance <= -half) return 0;
  if (left == 0) return weight * share_beyond(distance, walls_.nearest(middle).away, widths);
  const Place part{0.5 * widths[0], 0.5 * widths[1], 0.5 * widths[2]};
  double open = 0;
  int parts = 0;
  for (int n = 0; n < 8; ++n) {
    Place at = middle;
    bool there = true;
    for (std::size_t a = 0; a < 3; ++a) {
      const int side = n >> a & 1;
      at[a] += (side - 0.5) * part[a];
      there = there && (side == 0 || widths[a] > 0);
    }
    if (!there) continue;
    open += open_part(at, part, left - 1);
    ++parts;
  }
  return open / parts;
}

void Cutting::cut() {
  const double far = std::hypot(h_[0], h_[1], axes_ == 3 ? h_[2] : 0);
  for_each_cell([&](const Cell& c) {
    if (walls_.distance(centre(c)) > far) return;
    volume(c) *= open_share(centre(c), h_);
    for (int axis = 0; axis < axes_; ++axis)
      for (const int side : {0, 1}) {
        const auto a = std::size_t(axis);
        if (side == 1 && c[a] + 1 < n_[a]) continue;
        Place middle = centre(c), widths = h_;
        middle[a] += (side - 0.5) * h_[a];
        widths[a] = 0;
        double& open = side_face(c, axis, side);
        open *= open_share(middle, widths);
        if (open < least_face * whole(c)) open = 0;
      }
  });
}

/// Gives a cell away. A face to another small cell becomes one between their takers; a face to a cell that stays
/// closes, and its area counts as that cell's wall: a flow with one gradient is rubbed as much.
void Cutting::absorb(const Cell& c) {
  double most = 0;
  const auto area = [&](int axis, int side) { return side_face(c, axis, side) / h_[std::size_t(axis)]; };
  for_each_neighbour(c, [&](const Cell&, int axis, int side) { most = std::max(most, area(axis, side)); });
  const auto takes = [&](int axis, int side) { return most > 0 && area(axis, side) > (1 - 1e-6) * most; };
  std::vector<std::array<int, 2>> takers;
  for_each_neighbour(c, [&](const Cell&, int axis, int side) {
    if (takes(axis, side)) takers.push_back({axis, side});
  });
  const auto share = takers.empty() ? 0 : 1 / double(takers.size());
  for (const auto& [along, toward] : takers) {
    const Cell taker = next(c, along, 2 * toward - 1);
    volume(taker) += share * volume(c);
    for (int axis = 0; axis < axes_; ++axis)
      for (const int side : {0, 1})
        if (double& open = side_face(taker, axis, side);
            axis != along && open > 0 && is_small(next(c, axis, 2 * side - 1)))
          open += share * side_face(c, axis, side);
  }
  close(c);
}

/// The cells that lie deepest in a wall come first, so that they are passed on with their takers.
void Cutting::merge_small_cells() {
  std::vector<std::pair<float, Cell>> small;
  const double half = 0.5 * std::hypot(h_[0], h_[1], axes_ == 3 ? h_[2] : 0);
  small_.assign(std::size_t(n_[0]) * std::size_t(n_[1]) * std::size_t(n_[2]), false);
  for_each_cell([&](const Cell& c) {
    const double distance = walls_.distance(centre(c));
    if (!(volume(c) > 0)) return close(c);
    if (!(distance < half && volume(c) < least_cell * whole(c))) return;
    small.emplace_back(float(distance / half), c);
    small_[number(c)] = true;
  });
  std::stable_sort(small.begin(), small.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [depth, c] : small)
    if (volume(c) < least_cell * whole(c)) absorb(c);
}

void Cutting::close_what_is_cut_off() {
  std::vector<int> part(std::size_t(n_[0]) * std::size_t(n_[1]) * std::size_t(n_[2]), 0);
  const auto part_of = [&](const Cell& c) -> int& { return part[number(c)]; };
  int parts = 0, greatest = 0;
  std::size_t most = 0;
  for_each_cell([&](const Cell& first) {
    if (!(volume(first) > 0) || part_of(first) > 0) return;
    part_of(first) = ++parts;
    std::vector<Cell> reached{first};
    for (std::size_t n = 0; n < reached.size(); ++n) {
      const Cell c = reached[n];
      for_each_neighbour(c, [&](const Cell& other, int axis, int side) {
        if (!(side_face(c, axis, side) > 0) || part_of(other) > 0) return;
        part_of(other) = parts;
        reached.push_back(other);
      });
    }
    if (reached.size() <= most) return;
    most = reached.size();
    greatest = parts;
  });
  std::array<bool, 2> ends{};
  std::optional<std::size_t> hollow;
  std::vector<bool> from_bottom(std::size_t(parts) + 1);
  for_each_cell([&](const Cell& c) {  // from the bottom up
    if (c[1] == 0) from_bottom[std::size_t(part_of(c))] = true;
    if (part_of(c) == greatest) {
      if (c[1] == 0) ends[0] = true;
      if (c[1] == n_[1] - 1) ends[1] = true;
      return;
    }
    if (!hollow && volume(c) >= whole(c) && !from_bottom[std::size_t(part_of(c))])
      hollow = walls_.nearest(centre(c)).wall;
    close(c);
  });
  if (!ends[0] || !ends[1])
    throw StartError("[[wall]]: the walls leave no way for the fluid from the bottom to the top: move them apart");
  if (hollow)
    throw StartError(
        fmt::format("[[wall]] number {} encloses a hollow that the fluid cannot reach on these cells: open it by two "
                    "cells or more, "
                    "or fill it with a thicker wall",
                    *hollow + 1));
}

// The areas of a cell's faces and its walls sum to zero; of the wall's area the part across its normal counts, so that
// a linear profile is exact beside a plane. Around an axis the radial area of a whole cell is 2/n_x.
void Cutting::set_friction(const std::vector<CrossSection>& before) {
  const double least = 0.1 * *std::min_element(h_.begin(), h_.begin() + axes_);
  for (CrossSection& layer : layers_)
    for (int a = 0; a < axes_; ++a) layer.wall_along[std::size_t(a)].assign(layer.volume.size(), 0.0);
  for_each_cell([&](const Cell& c) {
    const double theta = volume(c);
    if (!(theta > 0)) return;
    Place area{};
    const FromWall nearest = walls_.nearest(centre(c));
    double facing = 0;
    for (int axis = 0; axis < axes_; ++axis) {
      const auto a = std::size_t(axis);
      const Cell high = next(c, axis, 1);
      area[a] = ((face(c, axis) - face(high, axis)) - (face_in(before, c, axis) - face_in(before, high, axis))) / h_[a];
      if (rings_ && axis == 0) area[a] -= 2.0 / n_[0] * (1 - theta / before[std::size_t(c[1])].volume[at(c)]) / h_[0];
      facing -= area[a] * nearest.away[a];
    }
    const double friction = std::max(facing, 0.0) / (std::max(nearest.distance, least) * theta);
    for (int axis = 0; axis < axes_; ++axis) {
      double& wall = layers_[std::size_t(c[1])].wall_along[std::size_t(axis)][at(c)];
      wall += friction * (1 - nearest.away[std::size_t(axis)] * nearest.away[std::size_t(axis)]);
      for (int across = 0; across < axes_; ++across) {  // between two walls whose areas cancel
        const double h = h_[std::size_t(across)];
        if (across == axis || face(c, across) > 0 || side_face(c, across, 1) > 0) continue;
        if (face_in(before, c, across) > 0 && face_in(before, next(c, across, 1), across) > 0) wall += 4 / (h * h);
      }
    }
  });
}

}  // namespace

std::vector<CrossSection> cut_by_walls(const Grid& column, const InnerWalls& walls, bool rings,
                                       const std::vector<CrossSection>& layers) {
  std::vector<CrossSection> cut = layers;
  Cutting cutting(column, walls, rings, cut);
  cutting.cut();
  cutting.merge_small_cells();
  cutting.close_what_is_cut_off();
  cutting.set_friction(layers);
  return cut;
}

}  // namespace polybed::core
