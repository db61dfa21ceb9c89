#include "dem/feed_strip.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/ranks.hpp"
#include "dem/model.hpp"

namespace polybed::dem {

namespace {

constexpr std::size_t numbers_of_sphere = 4;

/// The data of every rank, on all ranks. Sums with zeros are exact, and the order of the ranks has no effect here.
std::vector<double> of_all_ranks(const core::Ranks* ranks, std::vector<double> own) {
  if (ranks == nullptr) return own;
  std::vector<std::int64_t> size(std::size_t(ranks->count()), 0);
  size[std::size_t(ranks->rank())] = std::int64_t(own.size());
  core::add_over_ranks(ranks, size);
  std::int64_t before = 0, sum = 0;
  for (std::size_t r = 0; r < size.size(); ++r) {
    if (int(r) == ranks->rank()) before = sum;
    sum += size[r];
  }
  std::vector<double> all(std::size_t(sum), 0.0);
  std::copy(own.begin(), own.end(), all.begin() + before);
  core::add_over_ranks(ranks, all);
  return all;
}

}  // namespace

FeedStrip::FeedStrip(const Model& model, core::ColumnFace at) : box_(model.box()), across_(across(at)) {
  const auto a = std::size_t(axis_of(at));
  const double widest = model.materials().greatest_diameter(), far = box_.size[a];
  for (std::size_t n = 0; n < across_.size(); ++n) bins_[n] = std::max(1, int(box_.size[across_[n]] / widest));
  inside_.resize(std::size_t(bins_[0]) * std::size_t(bins_[1]));
  const bool curved = box_.round && is_side(at);
  const Particles& particles = model.particles();
  std::vector<double> own;
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const auto& [x, radius] = particles.place[i];
    // Entering particles lie within the largest diameter of the face, apart from a tiny gap.
    const double away = (curved ? 0.5 * far - box_.from_axis(x) : side_of(at) == 1 ? far - x[a] : x[a]) - radius;
    if (away < 1.5 * widest) own.insert(own.end(), {x[0], x[1], x[2], radius});
  }
  const std::vector<double> all = of_all_ranks(model.ranks(), std::move(own));
  for (const double* s = all.data(); s != all.data() + all.size(); s += numbers_of_sphere)
    add({{s[0], s[1], s[2]}, s[3]});
}

/// Particles stray beyond walls by their overlaps, and beyond joined faces until the list is rebuilt.
int FeedStrip::place_of(double x, std::size_t n) const {
  const std::size_t axis = across_[n];
  const double share = x / box_.size[axis];
  const double within = box_.periodic[axis] ? share - std::floor(share) : share;
  return std::clamp(int(within * bins_[n]), 0, bins_[n] - 1);
}

std::size_t FeedStrip::bin(int i, int k) const { return std::size_t(i) * std::size_t(bins_[1]) + std::size_t(k); }

void FeedStrip::add(const Place& sphere) {
  inside_[bin(place_of(sphere.x[across_[0]], 0), place_of(sphere.x[across_[1]], 1))].push_back(sphere);
}

bool FeedStrip::overlap(const Place& a, const Place& b) const {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double d = a.x[k] - b.x[k];
    if (box_.periodic[k]) d -= box_.size[k] * std::round(d / box_.size[k]);
    square += d * d;
  }
  const double touch = a.radius + b.radius;
  return square < touch * touch;
}

bool FeedStrip::has_room_for(const Place& sphere) const {
  if (!box_.within_side(sphere)) return false;
  for (const Plate& plate : box_.plates)
    if (plate.gap(plate.in_plane(sphere.x)) < sphere.radius) return false;
  const int i = place_of(sphere.x[across_[0]], 0), k = place_of(sphere.x[across_[1]], 1);
  // A bin that is its own neighbour is searched again, without effect.
  const auto near = [this](int n, std::size_t axis) {
    const int bins = bins_[axis];
    return box_.periodic[across_[axis]] ? (n + bins) % bins : std::clamp(n, 0, bins - 1);
  };
  for (int di = -1; di <= 1; ++di)
    for (int dk = -1; dk <= 1; ++dk)
      for (const Place& other : inside_[bin(near(i + di, 0), near(k + dk, 1))])
        if (overlap(sphere, other)) return false;
  return true;
}

}  // namespace polybed::dem
