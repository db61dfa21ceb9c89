#include "dem/coupling/round_weights.hpp"

#include <cmath>
#include <limits>
#include <span>

#include "core/numerics/cross_sections.hpp"

namespace polybed::dem {

namespace {

/// Farther from the wall, in cells, g = 1: cells and their neighbours are whole there.
constexpr int cells_to_fit = 3;

/// Sample places along each horizontal axis of a cell for the fit of g. In a tapered column each layer is sampled at
/// three heights, with another number at each, so that the samples do not line up along a straight wall.
constexpr std::array<int, 1> points{16};
constexpr std::array<int, 3> points_of_tapered{4, 6, 8};

/// V of the entries in whole cells, from the bottom; 0 if both cells are closed.
std::vector<double> volumes(const core::Grid& grid, int of, int layers) {
  const core::Metric& metric = *grid.metric;
  const auto theta = [&](int i, int j, int k) {
    const core::CrossSection& section = metric.layer(j);
    const bool inside = i >= 0 && i < section.width && k >= 0 && k < section.depth;
    return inside && (layers == 1 || (j >= 0 && j < grid.cells[1])) ? section.volume[section.at(i, k)] : 0.0;
  };
  std::vector<double> volume;
  for (int j = 0; j < layers; ++j)
    for (int k = 0; k < grid.cells[2] + (of == 2 ? 1 : 0); ++k)
      for (int i = 0; i < grid.cells[0] + (of == 0 ? 1 : 0); ++i) {
        const double low = of == 0 ? theta(i - 1, j, k) : of == 1 ? theta(i, j - 1, k) : theta(i, j, k - 1);
        volume.push_back(of < 0 ? theta(i, j, k) : 0.5 * (theta(i, j, k) + low));
      }
  return volume;
}

/// The centre of an open cell of each entry, m: its own, or one of the two beside a face.
std::vector<Vector> open_centres(const core::Grid& grid, int of) {
  std::array<int, 3> count = grid.cells;
  if (of >= 0) ++count[std::size_t(of)];
  std::vector<Vector> centres;
  for (int j = 0; j < count[1]; ++j)
    for (int k = 0; k < count[2]; ++k)
      for (int i = 0; i < count[0]; ++i) {
        std::array<int, 3> cell{i, j, k};
        const auto is_open = [&] {
          for (std::size_t a = 0; a < 3; ++a)
            if (cell[a] < 0 || cell[a] >= grid.cells[a]) return false;
          const core::CrossSection& section = grid.metric->layer(cell[1]);
          return section.volume[section.at(cell[0], cell[2])] > 0;
        };
        if (of >= 0 && !is_open()) --cell[std::size_t(of)];
        Vector centre{};
        for (std::size_t a = 0; a < 3; ++a) centre[a] = (cell[a] + 0.5) * grid.spacing[a];
        centres.push_back(centre);
      }
  return centres;
}

/// Radius of a column, m; the smaller one at a step.
double radius_of(const core::Grid& grid, double height) {
  const core::Taper& taper = grid.metric->taper;
  if (taper.empty()) return 0.5 * grid.cells[0] * grid.spacing[0];
  return std::min(core::radius_at(taper, height, 1), core::radius_at(taper, height, -1));
}

}  // namespace

EntryWeights::EntryWeights(const core::Grid& grid, int of)
    : graded_(grid.layers),
      alike_(!grid.metric->tapered()),
      lift_(grid.stride(1)),
      radius_(0.5 * grid.cells[0] * grid.spacing[0]) {
  if (grid.metric->walls) {
    std::array<double, 3> size{};
    for (std::size_t a = 0; a < 3; ++a) size[a] = grid.cells[a] * grid.spacing[a];
    walls_ = std::make_shared<core::InnerWalls>(*grid.metric->walls, size, false);
  }
  for (int a = 0; a < 3; ++a) {
    count_[std::size_t(a)] = grid.cells[std::size_t(a)] + (of == a ? 1 : 0);
    per_spacing_[std::size_t(a)] = 1 / grid.spacing[std::size_t(a)];
    offset_[std::size_t(a)] = of == a ? 0 : 0.5;
  }
  const std::vector<double> volume = volumes(grid, of, int(layers()));
  if (walls_) seen_at_ = open_centres(grid, of);
  for (int j = 0; j < int(layers()); ++j)
    for (int k = 0; k < count_[2]; ++k)
      for (int i = 0; i < count_[0]; ++i) {
        const std::size_t to = taker(volume, i, j, k), row = std::size_t(count_[0]),
                          layer = row * std::size_t(count_[2]);
        entries_.push_back({to, grid.index(int(to % row), int(to / layer), int(to % layer / row)), 0});
      }
  if (walls_) divide_sides(grid, volume);
  seen_at_ = {};
  fit(grid, volume);
}

/// Distance of an entry from the axis of the column, m.
double EntryWeights::distance(int i, int k) const {
  return std::hypot((i + offset_[0]) / per_spacing_[0] - radius_, (k + offset_[2]) / per_spacing_[2] - radius_);
}

/// The entry that takes the share on another: itself if it is open, else the one above or below if that is open, else
/// in the nearest ring with open entries the one nearest to the axis, so that mirror images go to mirror images.
std::size_t EntryWeights::taker(const std::vector<double>& volume, int i, int layer, int k) const {
  const auto of = [&](int x, int j, int z) { return entry(std::size_t(x), std::size_t(j), std::size_t(z)); };
  if (walls_) return taker_between_walls(volume, i, layer, k);
  for (const int j : {layer, layer + 1, layer - 1})
    if (j >= 0 && j < int(layers()) && volume[of(i, j, k)] > 0) return of(i, j, k);
  std::size_t found = of(i, layer, k);
  for (int ring = 1; !(volume[found] > 0); ++ring) {
    double least = std::numeric_limits<double>::infinity();
    for (int z = std::max(k - ring, 0); z <= std::min(k + ring, count_[2] - 1); ++z)
      for (int x = std::max(i - ring, 0); x <= std::min(i + ring, count_[0] - 1); ++x) {
        // At equal distance from the axis the nearer one wins.
        const double away = distance(x, z) + 1e-6 * radius_ * std::hypot(x - i, z - k);
        if (!(volume[of(x, layer, z)] > 0) || away >= least) continue;
        least = away;
        found = of(x, layer, z);
      }
  }
  return found;
}

Vector EntryWeights::place_of(std::size_t n) const {
  const auto row = std::size_t(count_[0]), layer = row * std::size_t(count_[2]);
  const std::array<std::size_t, 3> cell{n % row, n / layer, n % layer / row};
  Vector place{};
  for (std::size_t a = 0; a < 3; ++a) place[a] = (double(cell[a]) + offset_[a]) / per_spacing_[a];
  return place;
}

/// Whether no wall lies between a place outside the walls and an entry: a straight way goes nowhere deeper into one
/// than a quarter of a cell. Walls are at least one cell thick.
bool EntryWeights::sees(const Vector& from, std::size_t n) const {
  const Vector& to = seen_at_[n];
  double cells = 0;
  for (std::size_t a = 0; a < 3; ++a) cells = std::max(cells, std::abs(to[a] - from[a]) * per_spacing_[a]);
  const double deepest = -0.25 / *std::max_element(per_spacing_.begin(), per_spacing_.begin() + 2);
  const int steps = 1 + int(4 * cells);
  for (int s = 0; s <= steps; ++s) {
    Vector at{};
    for (std::size_t a = 0; a < 3; ++a) at[a] = from[a] + s * (to[a] - from[a]) / steps;
    if (walls_->distance(at) < deepest) return false;
  }
  return true;
}

/// The open entry nearest to a place. \param from  among those that it sees, if there are any within four cells
std::size_t EntryWeights::nearest_open(const std::vector<double>& volume, const Vector& place,
                                       const Vector* from) const {
  constexpr int far = 4;
  std::array<int, 3> middle{};
  for (std::size_t a = 0; a < 3; ++a)
    middle[a] = std::clamp(int(std::lround(place[a] * per_spacing_[a] - offset_[a])), 0, count_[a] - 1);
  for (int reach = 1;; reach *= 2) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t found = 0;
    const auto low = [&](std::size_t a) { return std::max(middle[a] - reach, 0); };
    const auto end = [&](std::size_t a) { return std::min(middle[a] + reach + 1, count_[a]); };
    for (int y = low(1); y < end(1); ++y)
      for (int z = low(2); z < end(2); ++z)
        for (int x = low(0); x < end(0); ++x) {
          const std::size_t n = entry(std::size_t(x), std::size_t(y), std::size_t(z));
          if (!(volume[n] > 0)) continue;
          const Vector there = place_of(n);
          double away = 0;
          for (std::size_t a = 0; a < 3; ++a) {
            const double by = (there[a] - place[a]) * per_spacing_[a];
            away += by * by;
          }
          if (away >= least || (from != nullptr && !sees(*from, n))) continue;
          least = away;
          found = n;
        }
    const bool is_nearest = least <= (reach + 0.5) * (reach + 0.5);
    if (is_nearest || (std::isfinite(least) && reach > *std::max_element(count_.begin(), count_.end()))) return found;
    if (from != nullptr && reach >= far) return std::isfinite(least) ? found : nearest_open(volume, place, nullptr);
  }
}

/// The open entry nearest to an entry, or to the point of the wall's surface nearest to it.
std::size_t EntryWeights::taker_between_walls(const std::vector<double>& volume, int i, int j, int k) const {
  const std::size_t own = entry(std::size_t(i), std::size_t(j), std::size_t(k));
  if (volume[own] > 0) return own;
  Vector place = place_of(own);
  const core::FromWall wall = walls_->nearest(place);
  for (std::size_t a = 0; a < 3; ++a) place[a] -= std::min(wall.distance, 0.0) * wall.away[a];
  return nearest_open(volume, place, nullptr);
}

/// Finds takers for entries near walls as corners of the boxes between entries: a box with room for a centre has it on
/// one side of a wall, as walls are at least one cell thick, and its shares go to entries on that side.
void EntryWeights::divide_sides(const core::Grid& grid, const std::vector<double>& volume) {
  const std::array<double, 3> h{grid.spacing[0], grid.spacing[1], grid.dimensions == 3 ? grid.spacing[2] : 0};
  const double half = 0.5 * std::sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
  for (std::size_t e = 0; e < volume.size(); ++e) {
    const Vector place = place_of(e);
    if (std::abs(walls_->distance(place)) > 2 * half) continue;
    std::array<std::size_t, 8> takers{};
    bool differ = false;
    for (std::size_t n = 0; n < 8; ++n) {
      takers[n] = entries_[e].taker;
      Vector middle = place;
      const std::array<std::size_t, 3> high{n & 1, n >> 2 & 1, n >> 1 & 1};
      for (std::size_t a = 0; a < 3; ++a) middle[a] += (0.5 - double(high[a])) * h[a];
      const core::FromWall wall = walls_->nearest(middle);
      if (wall.distance <= -half) continue;  // no room
      for (std::size_t a = 0; a < 3; ++a) middle[a] -= std::min(wall.distance, 0.0) * wall.away[a];
      if (sees(middle, takers[n])) continue;
      takers[n] = nearest_open(volume, place, &middle);
      differ = differ || takers[n] != entries_[e].taker;
    }
    if (!differ) continue;
    entries_[e].corners = int(corners_.size());
    corners_.push_back(takers);
  }
}

/// Whether the weight of an entry is fitted: near a wall inside.
bool EntryWeights::near_wall(std::size_t n) const {
  return walls_->distance(place_of(n)) <
         cells_to_fit / *std::min_element(per_spacing_.begin(), per_spacing_.begin() + 2);
}

/// The mirror image of an entry that lies in the quarter of low x and z.
std::size_t EntryWeights::in_quarter(std::size_t n) const {
  if (walls_) return n;
  const auto row = std::size_t(count_[0]), layer = row * std::size_t(count_[2]);
  const std::size_t i = n % row, k = n % layer / row;
  return entry(std::min(i, row - 1 - i), n / layer, std::min(k, std::size_t(count_[2]) - 1 - k));
}

/// Calls body(around, share of a cell's volume) for evenly spaced places that touch entries with fitted weights: in a
/// quarter of a round column, or anywhere between walls inside.
template <class Body>
void EntryWeights::for_each_place(const core::Grid& grid, Body&& body) const {
  const double hx = grid.spacing[0], hz = grid.spacing[2];
  const double far = (cells_to_fit + 2) * std::max({hx, grid.spacing[1], grid.dimensions == 3 ? hz : 0});
  const auto layer = [&](int j, std::span<const int> all) {
    const auto heights = double(all.size());
    for (std::size_t m = 0; m < all.size(); ++m) {
      const int n = all[m];
      const double y = (j + (double(m) + 0.5) / heights) * grid.spacing[1], radius = radius_of(grid, y);
      const double inner = alike_ ? radius - (cells_to_fit + 2) * std::max(hx, hz) : 0;
      const int part = walls_ ? 1 : 2, nz = grid.dimensions == 2 ? 1 : n;
      for (int k = 0; part * k < nz * grid.cells[2]; ++k)
        for (int i = 0; part * i < n * grid.cells[0]; ++i) {
          const double x = (i + 0.5) * hx / n, z = (k + 0.5) * hz / nz, away = std::hypot(x - radius_, z - radius_);
          if (walls_) {
            const double distance = walls_->distance({x, y, z});
            const bool inside = grid.metric->shape == core::ColumnShape::box || away <= radius;
            if (distance > 0 && distance < far && inside) body(find({x, y, z}), 1 / (heights * n * nz));
            continue;
          }
          if (away >= inner && away <= radius) body(find({x, y, z}), 1 / (heights * n * n));
        }
    }
  };
  if (alike_) return layer(0, points);
  for (int j = 0; j < grid.cells[1]; ++j) layer(j, points_of_tapered);
}

/// Fits g of the quarter's entries and their mirror images. Each round multiplies it by the volume of an entry over the
/// volume that evenly placed particles fill.
void EntryWeights::fit(const core::Grid& grid, const std::vector<double>& volume) {
  const int rounds = alike_ ? 20 : 10;
  const double inner = alike_ ? radius_ - cells_to_fit / std::min(per_spacing_[0], per_spacing_[2]) : -1;
  std::vector<std::size_t> image(volume.size());
  std::vector<double> weight(volume.size(), 0.0), whole(volume.size(), 0.0), filled(volume.size());
  for (std::size_t e = 0; e < volume.size(); ++e) {
    image[e] = in_quarter(entries_[e].taker);
    weight[e] = volume[in_quarter(e)];
    whole[in_quarter(e)] += (walls_ ? 1 : 0.25) * weight[e];
  }
  std::vector<bool> fitted;
  for (std::size_t e = 0; e < volume.size(); ++e)
    fitted.push_back(walls_ ? near_wall(e)
                            : distance(int(e % std::size_t(count_[0])), int(e / std::size_t(count_[0])) % count_[2]) >
                                  inner);
  for (int round = 0; round < rounds; ++round) {
    std::fill(filled.begin(), filled.end(), 0.0);
    for_each_place(grid, [&](const Around& around, double part) {
      double sum = 0;
      for (std::size_t n = 0; n < 8; ++n) sum += around.w[n] * weight[image[around.entry[n]]];
      for (std::size_t n = 0; n < 8; ++n) {
        const std::size_t to = image[around.entry[n]];
        filled[to] += around.w[n] * weight[to] * part / sum;
      }
    });
    for (std::size_t e = 0; e < volume.size(); ++e)
      if (fitted[e] && filled[e] > 0) weight[e] *= whole[e] / filled[e];
  }
  for (std::size_t e = 0; e < volume.size(); ++e) entries_[e].weight = weight[image[e]];
}

std::shared_ptr<const RoundWeights> round_weights(const core::Grid& grid) {
  if (!grid.metric || !grid.metric->cut()) return nullptr;
  if (grid.metric->ducts.empty()) return std::make_shared<RoundWeights>(grid);
  core::Grid plain = grid;  // no particle lies in a duct, beyond the side
  plain.metric = core::metric_of(grid, grid.metric->shape, grid.metric->taper, grid.metric->walls);
  return std::make_shared<RoundWeights>(plain);
}

}  // namespace polybed::dem
