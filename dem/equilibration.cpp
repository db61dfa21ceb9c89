// Random moves that turn an arrangement of hard spheres into an equilibrium fluid.
#include "dem/hard_spheres.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "closures/kinetic_theory.hpp"
#include "core/interrupt.hpp"
#include "core/numerics/random.hpp"

namespace polybed::dem {

namespace {

/// After spheres were pushed apart with gaps, this number brings pair distributions within 5 % of the fluid's up to a
/// fraction of 0.5 (one size), measured; many more would be needed above 0.55, where hard spheres become a glass.
constexpr int sweeps = 20;

struct Lengths {
  double step, skin;  ///< m; longest step along an axis, and approach of two spheres before they are listed
};

/// A step of about the free path between collisions, d/(6 phi g0), so that a third to a half of the steps are accepted.
Lengths lengths_for(double diameter, double fraction) {
  const double most = 0.2, g0 = closures::radial_carnahan_starling(fraction).value;
  const double step = std::min(most, 1 / (6 * fraction * g0));
  return {step * diameter, (0.5 + 5 * step) * diameter};
}

struct Neighbour {
  std::int32_t other, image;
};

class Metropolis {
 public:
  Metropolis(HardSpheres& spheres, Lengths lengths)
      : spheres_(spheres), place_(spheres.places()), step_(lengths.step), skin_(lengths.skin) {}

  void sweep(std::uint64_t key) {
    if (first_.empty() || 2 * (farthest_ + std::sqrt(3.0) * step_) > skin_) list();
    double square = farthest_ * farthest_;
    for (std::size_t i = 0; i < place_.size(); ++i) {
      const Vector x = tried(i, core::mixed_bits(key + i));
      if (!is_free(i, x)) continue;
      place_[i].x = x;
      const Vector& from = listed_[i].x;
      const double dx = x[0] - from[0], dy = x[1] - from[1], dz = x[2] - from[2];
      square = std::max(square, dx * dx + dy * dy + dz * dz);
    }
    farthest_ = std::sqrt(square);
  }

 private:
  /// Lists the neighbours of each sphere, one sphere after the other.
  void list() {
    spheres_.list(skin_);
    const std::vector<Contacts::Pair>& pairs = spheres_.pairs();
    first_.assign(place_.size() + 1, 0);
    for (const Contacts::Pair& pair : pairs)
      for (const std::int32_t i : {pair.first, pair.second}) ++first_[std::size_t(i) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    neighbours_.resize(2 * pairs.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const Contacts::Pair& pair : pairs) {
      neighbours_[next[std::size_t(pair.first)]++] = {pair.second, pair.image};
      neighbours_[next[std::size_t(pair.second)]++] = {pair.first, Images::opposite(pair.image)};
    }
    listed_ = place_;
    farthest_ = 0;
  }

  /// Uses 21 bits for each axis.
  [[nodiscard]] Vector tried(std::size_t i, std::uint64_t bits) const {
    constexpr std::uint64_t mask = 0x1fffff;
    Vector x = place_[i].x;
    for (std::size_t k = 0; k < 3; ++k) x[k] += step_ * (0x1p-20 * double(std::int64_t(bits >> 21 * k & mask)) - 1);
    return x;
  }

  [[nodiscard]] bool is_free(std::size_t i, const Vector& x) const {
    const Region& bounds = spheres_.bounds()[i];
    for (std::size_t k = 0; k < 3; ++k)
      if (x[k] < bounds.low[k] || x[k] > bounds.high[k]) return false;
    if (!bounds.within_side(x)) return false;
    for (std::size_t n = first_[i]; n < first_[i + 1]; ++n) {
      const Place& there = place_[std::size_t(neighbours_[n].other)];
      const Vector& shift = spheres_.shift(neighbours_[n].image);
      const double dx = x[0] - there.x[0] - shift[0], dy = x[1] - there.x[1] - shift[1];
      const double dz = x[2] - there.x[2] - shift[2], touch = place_[i].radius + there.radius;
      if (dx * dx + dy * dy + dz * dz < touch * touch) return false;
    }
    return true;
  }

  HardSpheres& spheres_;
  std::vector<Place>& place_;
  double step_, skin_;
  std::vector<std::size_t> first_;  ///< for each sphere, index in neighbours_
  std::vector<Neighbour> neighbours_;
  std::vector<Place> listed_;
  double farthest_ = 0;  ///< m, from the place at the last listing
};

}  // namespace

void equilibrate(HardSpheres& spheres, double least_diameter, double fraction, std::uint64_t seed) {
  Metropolis metropolis(spheres, lengths_for(least_diameter, fraction));
  for (int n = 0; n < sweeps; ++n) {
    core::stop_if_wanted("particles were placed");
    metropolis.sweep(core::mixed_bits(core::mixed_bits(seed) ^ std::uint64_t(n)));
  }
}

}  // namespace polybed::dem
