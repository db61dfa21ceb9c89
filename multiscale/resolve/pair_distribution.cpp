#include "multiscale/resolve/pair_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "closures/sphere.hpp"
#include "core/output/checkpoint.hpp"
#include "multiscale/resolve/packing.hpp"

namespace polybed::multiscale {

namespace {

constexpr double farthest = 3;

}  // namespace

PairDistribution::PairDistribution(std::vector<double> radius, std::vector<double> count, double edge)
    : radius_(std::move(radius)), count_(std::move(count)), edge_(edge) {
  std::size_t shells = 0;
  for (std::size_t j = 0; j < radius_.size(); ++j)
    for (std::size_t k = j; k < radius_.size(); ++k) {
      Pair pair{j, k, shells, 0};
      const double end = std::min(farthest, 0.5 * edge_ / (radius_[j] + radius_[k]));
      if (count_[j] * (count_[k] - (j == k ? 1 : 0)) > 0 && end > 1)
        pair.shells = std::size_t((end - 1) / width * (1 + 1e-12));
      shells += pair.shells;
      pairs_.push_back(pair);
    }
  number_.assign(shells, 0);
}

std::size_t PairDistribution::pair_of(std::size_t j, std::size_t k) const {
  const auto [low, high] = std::minmax(j, k);
  return low * radius_.size() - low * (low + 1) / 2 + high;
}

void PairDistribution::add(const std::vector<lattice::Sphere>& spheres, const std::vector<std::size_t>& species) {
  for (std::size_t a = 0; a < spheres.size(); ++a)
    for (std::size_t b = a + 1; b < spheres.size(); ++b) {
      const Pair& pair = pairs_[pair_of(species[a], species[b])];
      double square = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        double d = spheres[a].centre[axis] - spheres[b].centre[axis];
        d -= edge_ * std::round(d / edge_);
        square += d * d;
      }
      const double beyond = std::sqrt(square) / (radius_[pair.j] + radius_[pair.k]) - 1;
      const auto shell = std::size_t(std::max(beyond, 0.0) / width);
      if (shell < pair.shells) ++number_[pair.first + shell];
    }
  ++times_;
}

std::vector<double> PairDistribution::mean() const {
  std::vector<double> g = number_;
  for (const Pair& pair : pairs_) {
    const double contact = radius_[pair.j] + radius_[pair.k];
    const double pairs =
        pair.j == pair.k ? 0.5 * count_[pair.j] * (count_[pair.j] - 1) : count_[pair.j] * count_[pair.k];
    for (std::size_t n = 0; n < pair.shells; ++n) {
      const double inner = contact * (1 + double(n) * width), outer = inner + contact * width;
      const double share = (closures::sphere_volume(outer) - closures::sphere_volume(inner)) / std::pow(edge_, 3);
      if (times_ > 0) g[pair.first + n] /= times_ * pairs * share;
    }
  }
  return g;
}

auto PairDistribution::shells() const -> std::vector<Shell> {
  std::vector<Shell> all;
  for (const Pair& pair : pairs_)
    for (std::size_t n = 0; n < pair.shells; ++n) all.push_back({pair.j, pair.k, 1 + (double(n) + 0.5) * width});
  return all;
}

std::vector<double> PairDistribution::sums() const {
  std::vector<double> sums{times_};
  sums.insert(sums.end(), number_.begin(), number_.end());
  return sums;
}

void PairDistribution::restore(const std::vector<double>& sums) {
  if (sums.size() != number_.size() + 1) core::refuse_checkpoint("its pairs of spheres are those of another box");
  times_ = sums[0];
  number_.assign(sums.begin() + 1, sums.end());
}

PairDistribution pair_distribution(const core::Scene& scene, double voidage) {
  std::vector<double> radius, count;
  for (const core::Species& s : scene.species) radius.push_back(0.5 * s.diameter);
  for (const std::int64_t n : sphere_numbers(scene)) count.push_back(double(n));
  return {std::move(radius), std::move(count), box_length(scene, voidage)};
}

}  // namespace polybed::multiscale
