#include "dem/coupling/round_weights.hpp"

#include <limits>

#include "core/numerics/metric.hpp"

namespace polybed::dem {

namespace {

/// Farther from the wall, in cells, g = 1: there cells are whole, and so are those around them.
constexpr int cells_to_fit = 3;

/// Places along each axis of a cell by which g is fitted.
constexpr int points = 16;

/// V of the entries of a layer in whole cells; 0 where nothing of either cell is open.
std::vector<double> volumes(const core::CrossSection& section, int of) {
  const auto theta = [&](int i, int k) {
    const bool inside = i >= 0 && i < section.width && k >= 0 && k < section.depth;
    return inside ? section.volume[section.at(i, k)] : 0.0;
  };
  const int nx = section.width + (of == 0 ? 1 : 0), nz = section.depth + (of == 2 ? 1 : 0);
  std::vector<double> volume;
  for (int k = 0; k < nz; ++k)
    for (int i = 0; i < nx; ++i)
      volume.push_back(of < 0 ? theta(i, k)
                              : 0.5 * (theta(i, k) + theta(i - (of == 0 ? 1 : 0), k - (of == 2 ? 1 : 0))));
  return volume;
}

}  // namespace

LayerWeights::LayerWeights(const core::Grid& grid, int of)
    : count_{grid.cells[0] + (of == 0 ? 1 : 0), grid.cells[2] + (of == 2 ? 1 : 0)},
      per_spacing_{1 / grid.spacing[0], 1 / grid.spacing[2]},
      offset_{of == 0 ? 0 : 0.5, of == 2 ? 0 : 0.5},
      radius_(0.5 * grid.cells[0] * grid.spacing[0]) {
  const std::vector<double> volume = volumes(grid.metric->layers.front(), of);
  for (int k = 0; k < count_[1]; ++k)
    for (int i = 0; i < count_[0]; ++i) {
      const std::size_t to = taker(volume, i, k), row = std::size_t(count_[0]);
      const auto x = core::Index(to % row) + core::Grid::halo, z = core::Index(to / row) + core::Grid::halo;
      entries_.push_back({to, x * grid.stride(0) + z * grid.stride(2), 0});
    }
  fit(volume);
}

/// Of an entry from the axis of the column, m.
double LayerWeights::distance(int i, int k) const {
  return std::hypot((i + offset_[0]) / per_spacing_[0] - radius_, (k + offset_[1]) / per_spacing_[1] - radius_);
}

/// Which entry gets what stands on another: itself where it is open, else of the open ones in the nearest ring around
/// it the one nearest to the axis, so that mirror images go to mirror images.
std::size_t LayerWeights::taker(const std::vector<double>& volume, int i, int k) const {
  const auto entry = [this](int x, int z) { return std::size_t(x) + std::size_t(count_[0]) * std::size_t(z); };
  std::size_t found = entry(i, k);
  for (int ring = 1; !(volume[found] > 0); ++ring) {
    double least = std::numeric_limits<double>::infinity();
    for (int z = std::max(k - ring, 0); z <= std::min(k + ring, count_[1] - 1); ++z)
      for (int x = std::max(i - ring, 0); x <= std::min(i + ring, count_[0] - 1); ++x)
        if (volume[entry(x, z)] > 0 && distance(x, z) < least) {
          least = distance(x, z);
          found = entry(x, z);
        }
  }
  return found;
}

/// Places that lie evenly over the cross-section, as far as they touch entries whose weight is fitted.
std::vector<LayerWeights::Around> LayerWeights::places_to_fit() const {
  const double hx = 1 / per_spacing_[0], hz = 1 / per_spacing_[1];
  const double inner = radius_ - (cells_to_fit + 2) * std::max(hx, hz);
  const int nx = points * int(std::lround(2 * radius_ / hx)), nz = points * int(std::lround(2 * radius_ / hz));
  std::vector<Around> places;
  for (int k = 0; k < nz; ++k)
    for (int i = 0; i < nx; ++i) {
      const double x = (i + 0.5) * hx / points, z = (k + 0.5) * hz / points;
      const double away = std::hypot(x - radius_, z - radius_);
      if (away >= inner && away <= radius_) places.push_back(find(x, z));
    }
  return places;
}

/// Volumes, in cells, that particles fill which are at such places.
std::vector<double> LayerWeights::filled(const std::vector<Around>& places, const std::vector<double>& weight) const {
  std::vector<double> volume(weight.size(), 0.0);
  for (const Around& around : places) {
    double sum = 0;
    for (std::size_t n = 0; n < 4; ++n) sum += around.w[n] * weight[entries_[around.entry[n]].taker];
    for (std::size_t n = 0; n < 4; ++n) {
      const std::size_t to = entries_[around.entry[n]].taker;
      volume[to] += around.w[n] * weight[to] / (sum * points * points);
    }
  }
  return volume;
}

void LayerWeights::fit(const std::vector<double>& volume) {
  constexpr int rounds = 20;  // within 2 % of even then, in columns of 2 to 40 cells
  const double inner = radius_ - cells_to_fit / std::min(per_spacing_[0], per_spacing_[1]);
  const std::vector<Around> places = places_to_fit();
  std::vector<double> weight = volume;
  std::vector<bool> fitted;
  for (int k = 0; k < count_[1]; ++k)
    for (int i = 0; i < count_[0]; ++i) fitted.push_back(distance(i, k) > inner);
  for (int round = 0; round < rounds; ++round) {
    const std::vector<double> found = filled(places, weight);
    for (std::size_t e = 0; e < weight.size(); ++e)
      if (fitted[e] && found[e] > 0) weight[e] *= volume[e] / found[e];
  }
  for (Entry& entry : entries_) entry.weight = weight[entry.taker];
}

std::shared_ptr<const RoundWeights> round_weights(const core::Grid& grid) {
  return grid.metric ? std::make_shared<RoundWeights>(grid) : nullptr;
}

}  // namespace polybed::dem
