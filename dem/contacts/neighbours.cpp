#include "dem/contacts/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace polybed::dem {

namespace {

/// Cells on both sides of one: each at most once, none beyond an end that does not wrap.
struct Span {
  std::array<int, 3> cell{}, offset{};
  int count = 0;
  void add(int c, int from) {
    if (std::find(cell.begin(), cell.begin() + count, c) != cell.begin() + count) return;
    offset[std::size_t(count)] = from;
    cell[std::size_t(count++)] = c;
  }
};

Span around(int c, int count, bool wraps) {
  Span span;
  for (int k = -1; k <= 1; ++k) {
    if (wraps)
      span.add(c + k < 0 ? c + k + count : (c + k >= count ? c + k - count : c + k), k);
    else if (c + k >= 0 && c + k < count)
      span.add(c + k, k);
  }
  return span;
}

std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffffULL;
  x = (x | x << 16) & 0x1f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2) & 0x1249249249249249ULL;
}

/// Halves the number of cells along the longest direction until it is not much above the number of particles: a few
/// small particles in a box for large ones would otherwise need too many cells for memory.
void widen_cells(std::array<int, 3>& count, std::size_t particles) {
  const double most = 1e5 + 64 * double(particles);
  while (double(count[0]) * count[1] * count[2] > most) {
    int& longest = *std::max_element(count.begin(), count.end());
    longest = (longest + 1) / 2;
  }
}

}  // namespace

int NeighbourSearch::Level::place(double x, std::size_t axis) const {
  const int c = int(std::floor((x - low[axis]) * inverse[axis])), n = count[axis];
  if (!wraps[axis] || (c >= 0 && c < n)) return c;
  return ((c % n) + n) % n;
}

NeighbourSearch::NeighbourSearch(const Box& box, const Materials& materials, double reach, double wall_reach)
    : box_(box), materials_(materials) {
  for (std::size_t k = 0; k < 3; ++k)
    if (box.periodic[k]) {
      narrowest_ = std::min(narrowest_, box.size[k]);
      period_[k] = box.size[k];
    }
  set_reach(reach, wall_reach);
}

void NeighbourSearch::set_reach(double reach, double wall_reach) {
  reach_ = reach;
  wall_reach_ = wall_reach;
  levels_.clear();
  std::vector<double> diameters;
  for (const Species& species : materials_.species()) diameters.push_back(2 * species.radius);
  std::sort(diameters.begin(), diameters.end());
  // From the largest downwards: another level pays if its cells have less than half the volume.
  constexpr double worth_a_level = 1.25;
  for (auto d = diameters.rbegin(); d != diameters.rend(); ++d)
    if (levels_.empty() || worth_a_level * (*d + reach) < levels_.back().cell) levels_.emplace_back().cell = *d + reach;
  std::reverse(levels_.begin(), levels_.end());
}

std::size_t NeighbourSearch::level_of(double radius) const {
  std::size_t level = 0;
  while (level + 1 < levels_.size() && levels_[level].cell < 2 * radius + reach_) ++level;
  return level;
}

void NeighbourSearch::lay_out(const std::array<bool, 3>& whole) {
  for (Level& level : levels_) {
    std::array<double, 3> extents{};
    for (std::size_t k = 0; k < 3; ++k) {
      level.wraps[k] = box_.periodic[k] && whole[k];
      double low = 0, extent = box_.size[k];
      if (!level.wraps[k]) {
        double high = low = near_.empty() ? 0 : near_[0][k];
        for (const Vector& x : near_) {
          low = std::min(low, x[k]);
          high = std::max(high, x[k]);
        }
        extent = high - low;
      }
      // Wider cells are safe, narrower ones are not: wrapping cells are stretched to fill the box.
      const double most = double(std::cbrt(4.0 * double(near_.size()) + 64)) * 64;
      level.count[k] = std::max(1, int(std::min(std::floor(extent / level.cell), most)));
      level.low[k] = low;
      extents[k] = extent;
    }
    widen_cells(level.count, near_.size());
    for (std::size_t k = 0; k < 3; ++k) {
      const double extent = extents[k];
      if (level.wraps[k]) {
        level.inverse[k] = level.count[k] / extent;
      } else {
        level.count[k] += 1;
        const double cell = std::max(level.cell, extent / level.count[k] * (1 + 1e-12));
        level.inverse[k] = 1 / cell;
      }
    }
  }
  // If a sheared box has so few rows that one is met directly and as an image, all cells in a row are near.
  for (Level& level : levels_)
    if (box_.shear_rate != 0 && level.count[1] < 4) {
      level.count[0] = 1;
      level.inverse[0] = 1 / box_.size[0];
    }
}

void NeighbourSearch::sort_in(const Particles& particles) {
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& level = levels_[l];
    const auto cells = std::size_t(level.count[0]) * std::size_t(level.count[1]) * std::size_t(level.count[2]);
    level.start.assign(cells + 1, 0);
    level.next.assign(particles.size(), -1);
    std::vector<std::int32_t>& at = level.next;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      if (level_of(particles.place[i].radius) != l) continue;
      const Vector& x = near_[i];
      at[i] = (level.place(x[2], 2) * level.count[1] + level.place(x[1], 1)) * level.count[0] + level.place(x[0], 0);
      ++level.start[std::size_t(at[i]) + 1];
    }
    std::partial_sum(level.start.begin(), level.start.end(), level.start.begin());
    level.member.resize(std::size_t(level.start.back()));
    level.place_of_member.resize(level.member.size());
    std::vector<std::int32_t> next(level.start.begin(), level.start.end() - 1);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      if (at[i] < 0) continue;
      const auto m = std::size_t(next[std::size_t(at[i])]++);
      level.member[m] = std::int32_t(i);
      level.place_of_member[m] = particles.place[i];
      at[i] = std::int32_t(m) + 1;
    }
  }
}

/// Pairs of particle i with a level: all on coarser levels, each once on its own: those in half of the surrounding
/// cells, and those behind it in its cell; by the ids if cells are so few that one lies on both sides.
void NeighbourSearch::search(const Particles& particles, std::size_t i, std::size_t l, const Images& images,
                             std::vector<Contacts::Pair>& pairs) {
  const Level& level = levels_[l];
  const bool own = level_of(particles.place[i].radius) == l, half = own && level.roomy();
  const bool unsheared = box_.shear_rate == 0;
  const Vector& x = near_[i];
  const int at_y = level.place(x[1], 1);
  const Span depth = around(level.place(x[2], 2), level.count[2], level.wraps[2]);
  const Span height = around(at_y, level.count[1], level.wraps[1]);
  const Span beside = around(level.place(x[0], 0), level.count[0], level.wraps[0]);
  for (int row = 0; row < height.count; ++row) {
    const int cy = height.cell[std::size_t(row)], oy = height.offset[std::size_t(row)];
    // Across the joined faces of a sheared box the neighbouring cells are the image's.
    const int boxes = cy - at_y > 1 ? -1 : (cy - at_y < -1 ? 1 : 0);
    const Span width =
        unsheared || boxes == 0
            ? beside
            : around(level.place(x[0] - boxes * images.shift[Images::here + 3][0], 0), level.count[0], level.wraps[0]);
    for (int k = 0; k < depth.count; ++k) {
      const int oz = depth.offset[std::size_t(k)];
      if (half && (oz < 0 || (oz == 0 && oy < 0))) continue;
      const bool same = oz == 0 && oy == 0;
      const int first = (depth.cell[std::size_t(k)] * level.count[1] + cy) * level.count[0];
      // The members of cells in a row follow each other.
      for (int n = 0, last = 0; n < width.count; n = last + 1) {
        for (last = n;
             last + 1 < width.count && width.cell[std::size_t(last) + 1] == width.cell[std::size_t(last)] + 1;)
          ++last;
        if (half && same && width.offset[std::size_t(last)] < 0) continue;
        std::int32_t begin = level.start[std::size_t(first + width.cell[std::size_t(n)])];
        const std::int32_t end = level.start[std::size_t(first + width.cell[std::size_t(last)]) + 1];
        if (half && same && width.offset[std::size_t(n)] <= 0) begin = level.next[i];
        candidates_ += std::uint64_t(end - begin);
        for (std::int32_t m = begin; m < end; ++m) {
          const Place& there = level.place_of_member[std::size_t(m)];
          if (unsheared && !may_be_near(particles.place[i], there)) continue;
          const auto j = std::size_t(level.member[std::size_t(m)]);
          if (!half && own && particles.id[j] <= particles.id[i]) continue;
          add_if_near(particles, i, j, there, images, pairs);
        }
      }
    }
  }
}

/// Excludes most candidates without a branch on images; not in a sheared box, where images move along each other.
bool NeighbourSearch::may_be_near(const Place& here, const Place& there) const {
  constexpr double round_off = 1 + 1e-12;
  const double near = here.radius + there.radius + reach_;
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double direct = std::abs(here.x[k] - there.x[k]);
    const double least = std::min(direct, std::abs(period_[k] - direct));
    square += least * least;
  }
  return square < near * near * round_off;
}

void NeighbourSearch::add_if_near(const Particles& particles, std::size_t i, std::size_t j, const Place& there,
                                  const Images& images, std::vector<Contacts::Pair>& pairs) const {
  if (i >= particles.owned && j >= particles.owned) return;
  const Place& here = particles.place[i];
  const Vector d{here.x[0] - there.x[0], here.x[1] - there.x[1], here.x[2] - there.x[2]};
  const double near = here.radius + there.radius + reach_;
  const auto add = [&](int image) {
    const Vector seen = images.seen(d, image);
    if (seen[0] * seen[0] + seen[1] * seen[1] + seen[2] * seen[2] >= near * near) return;
    const auto a = std::int32_t(i), b = std::int32_t(j);
    const std::int32_t si = particles.species[i], sj = particles.species[j];
    if (particles.id[i] < particles.id[j])
      pairs.push_back({a, b, image, materials_.kind(si, sj)});
    else
      pairs.push_back({b, a, Images::opposite(image), materials_.kind(sj, si)});
  };
  const int nearest = images.nearest(d);
  add(nearest);
  if (2 * near > narrowest_) images.each_other(d, nearest, add);
}

/// Between two searches the contacts need the memory.
void NeighbourSearch::release() {
  std::vector<Vector>().swap(near_);
  for (Level& level : levels_) {
    std::vector<std::int32_t>().swap(level.start);
    std::vector<std::int32_t>().swap(level.member);
    std::vector<std::int32_t>().swap(level.next);
    std::vector<Place>().swap(level.place_of_member);
  }
}

void NeighbourSearch::find_pairs(const Particles& particles, double time, const Vector& centre,
                                 const std::array<bool, 3>& whole, Contacts& contacts) {
  std::vector<Contacts::Pair>& pairs = contacts.pairs;
  pairs.clear();
  candidates_ = 0;
  near_.resize(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = particles.place[i].x[k];
      near_[i][k] = box_.periodic[k] && !whole[k] ? x - box_.size[k] * std::round((x - centre[k]) / box_.size[k]) : x;
    }
  lay_out(whole);
  sort_in(particles);
  const Images images(box_, time, 0);
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (std::size_t l = level_of(particles.place[i].radius); l < levels_.size(); ++l)
      search(particles, i, l, images, pairs);
  release();
  contacts.inner = pairs.size();
  if (particles.size() == particles.owned) return;  // the sort needs as much memory again
  const auto here = std::int32_t(particles.owned);
  const auto outer = std::stable_partition(
      pairs.begin(), pairs.end(), [&](const Contacts::Pair& pair) { return pair.first < here && pair.second < here; });
  contacts.inner = std::size_t(outer - pairs.begin());
}

void NeighbourSearch::find_walls(const Particles& particles, std::vector<Contacts::Pair>& pairs) const {
  pairs.clear();
  for (std::size_t i = 0; i < particles.owned; ++i)
    for (std::size_t w = 0; w < box_.walls.size(); ++w) {
      const Wall& wall = box_.walls[w];
      const Vector& x = particles.place[i].x;
      double away = x[std::size_t(wall.axis)] - wall.place;
      if (wall.side != 0) away = -away;
      std::int32_t curve = 0;
      if (wall.plate >= 0) {
        const Plate& plate = box_.plates[std::size_t(wall.plate)];
        const InPlane d = plate.to(plate.in_plane(x));
        away = std::sqrt(d[0] * d[0] + d[1] * d[1]);
        curve = plate.curve_at(x);
      }
      if (away < particles.place[i].radius + wall_reach_)
        pairs.push_back(
            {std::int32_t(i), std::int32_t(w), Images::here, materials_.wall_kind(particles.species[i], curve)});
    }
}

std::vector<std::int32_t> NeighbourSearch::order(const Particles& particles) const {
  std::vector<std::uint64_t> key(particles.owned);
  const double cell = levels_.front().cell;
  for (std::size_t i = 0; i < particles.owned; ++i) {
    key[i] = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double place = particles.place[i].x[k] / cell + 1024;
      key[i] |= spread_bits(std::uint64_t(std::clamp(place, 0.0, 2.0e6))) << k;
    }
  }
  std::vector<std::int32_t> order(particles.owned);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    const auto ka = key[std::size_t(a)], kb = key[std::size_t(b)];
    return ka != kb ? ka < kb : particles.id[std::size_t(a)] < particles.id[std::size_t(b)];
  });
  return order;
}

}  // namespace polybed::dem
