// Random initial places of particles, as even over large distances as hard spheres.
#include "dem/hard_spheres.hpp"

#include <algorithm>
#include <cmath>

#include "closures/sphere.hpp"
#include "core/numerics/random.hpp"

namespace polybed::dem {

namespace {

enum Sequence : std::uint64_t { place_in_part = 16, rank = place_in_part + 3, lies_anywhere, cut_of_part };

/// Variance over mean of the number of hard spheres in a large volume (Carnahan and Starling, J. Chem. Phys. 51, 1969):
/// 1 for a dilute gas, 0.02 at a solids fraction of 0.5.
double number_variance(double fraction) {
  const double f = std::min(fraction, 0.64);
  return std::pow(1 - f, 4) / ((1 + 2 * f) * (1 + 2 * f) + f * f * f * (f - 4));
}

double volume_of(const Particle& p) { return closures::sphere_volume(p.place.radius); }

class Division {
 public:
  Division(const std::vector<Particle*>& particles, std::uint64_t seed) : particles_(particles), seed_(seed) {
    for (const Particle* p : particles) sum_.push_back(sum_.back() + volume_of(*p));
  }

  /// Divides the region across its longest side between the particles from `first` to before `end`.
  void place(std::size_t first, std::size_t end, const Region& region) {
    if (end - first == 1) {
      Particle& p = *particles_[first];
      for (std::size_t k = 0; k < 3; ++k)
        p.place.x[k] = region.low[k] +
                       (region.high[k] - region.low[k]) * core::uniform(seed_, place_in_part + k, std::uint64_t(p.id));
      return;
    }
    const double cut = 0.3 + 0.4 * core::uniform(seed_, cut_of_part, first * particles_.size() + end);
    const auto begin = sum_.begin() + std::ptrdiff_t(first + 1), last = sum_.begin() + std::ptrdiff_t(end - 1);
    const auto middle =
        std::size_t(std::lower_bound(begin, last, sum_[first] + cut * (sum_[end] - sum_[first])) - sum_.begin());
    const Vector size{region.high[0] - region.low[0], region.high[1] - region.low[1], region.high[2] - region.low[2]};
    const auto axis = std::size_t(std::max_element(size.begin(), size.end()) - size.begin());
    Region lower = region, upper = region;
    lower.high[axis] = upper.low[axis] =
        region.low[axis] + size[axis] * (sum_[middle] - sum_[first]) / (sum_[end] - sum_[first]);
    place(first, middle, lower);
    place(middle, end, upper);
  }

 private:
  const std::vector<Particle*>& particles_;
  std::uint64_t seed_;
  std::vector<double> sum_{0};  ///< m3, of the preceding particles
};

/// Between the corners of a region.
void spread_between_corners(const std::vector<Particle*>& particles, const Region& region, std::uint64_t seed) {
  double volume = 0;
  for (const Particle* p : particles) volume += volume_of(*p);
  const double share = number_variance(volume / region.volume());
  std::vector<std::pair<double, Particle*>> ranked;
  for (Particle* p : particles) {
    const auto id = std::uint64_t(p->id);
    if (core::uniform(seed, lies_anywhere, id) >= share)
      ranked.emplace_back(core::uniform(seed, rank, id), p);
    else
      for (std::size_t k = 0; k < 3; ++k)
        p->place.x[k] = region.low[k] + (region.high[k] - region.low[k]) * core::uniform(seed, place_in_part + k, id);
  }
  if (ranked.empty()) return;
  std::sort(ranked.begin(), ranked.end());
  std::vector<Particle*> in_order;
  for (const auto& [r, p] : ranked) in_order.push_back(p);
  Division(in_order, seed).place(0, in_order.size(), region);
}

}  // namespace

void spread(std::vector<Particle*>& particles, const Region& region, std::uint64_t seed) {
  spread_between_corners(particles, region.even(), seed);
  if (!region.round) return;
  for (Particle* p : particles) p->place.x = region.mapped_within_side(p->place.x);
}

}  // namespace polybed::dem
