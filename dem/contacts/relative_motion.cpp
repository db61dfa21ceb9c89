#include "dem/contacts/relative_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polybed::dem {

namespace {

/// Greatest displacement along each axis, then the least one with its sign changed: ranks need only the greatest
/// values.
using Extremes = std::array<double, 6>;

/// Square of the greatest difference of displacements between two blocks, m2.
double square_apart(const Extremes& a, const Extremes& b) {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double apart = std::max(a[k] + b[k + 3], b[k] + a[k + 3]);
    square += apart * apart;
  }
  return square;
}

constexpr double nobody = -std::numeric_limits<double>::infinity();

}  // namespace

RelativeMotion::RelativeMotion(const Box& box, double diameter, double reach, std::size_t particles)
    : joined_(box.periodic), far_(0.5 * diameter) {
  const double block = diameter + reach + 2 * far_;
  for (std::size_t k = 0; k < 3; ++k) count_[k] = std::max(1, int(std::min(std::floor(box.size[k] / block), 1e3)));
  // Larger blocks are safe: a few small particles in a large box do not need many.
  while (double(count_[0]) * count_[1] * count_[2] > 1e3 + double(particles)) {
    int& most = *std::max_element(count_.begin(), count_.end());
    most = (most + 1) / 2;
  }
  for (std::size_t k = 0; k < 3; ++k) inverse_[k] = count_[k] / box.size[k];
}

/// A particle beyond a face belongs to the outermost block, one beyond a joined face to the block of its image: blocks
/// that are not adjacent stay at least one block apart.
std::int32_t RelativeMotion::block_of(const Vector& x) const {
  std::array<int, 3> at{};
  for (std::size_t k = 0; k < 3; ++k) {
    double block = std::floor(x[k] * inverse_[k]);
    if (joined_[k]) block -= count_[k] * std::floor(block / count_[k]);
    at[k] = int(std::clamp(block, 0.0, count_[k] - 1.0));
  }
  return (at[2] * count_[1] + at[1]) * count_[0] + at[0];
}

void RelativeMotion::mark(const Particles& particles) {
  marked_.resize(particles.owned);
  block_.resize(particles.owned);
  for (std::size_t i = 0; i < particles.owned; ++i) {
    marked_[i] = particles.place[i].x;
    block_[i] = block_of(marked_[i]);
  }
}

RelativeMotion::Moved RelativeMotion::since(const Particles& particles, const core::Ranks* ranks) const {
  const auto blocks = std::size_t(count_[0]) * std::size_t(count_[1]) * std::size_t(count_[2]);
  std::vector<Extremes> moved(blocks + 1, {nobody, nobody, nobody, nobody, nobody, nobody});
  double most = 0;
  for (std::size_t i = 0; i < particles.owned; ++i) {
    Extremes& of = moved[std::size_t(block_[i])];
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double by = particles.place[i].x[k] - marked_[i][k];
      of[k] = std::max(of[k], by);
      of[k + 3] = std::max(of[k + 3], -by);
      square += by * by;
    }
    if (!(square <= most) && !std::isnan(most)) most = square;  // NaN stays
  }
  moved[blocks][0] = most;
  core::greatest_over_ranks(ranks, {moved[0].data(), 6 * moved.size()});
  double apart = 0;
  const auto next = [&](int at, int by, std::size_t k) {
    const int c = at + by;
    return joined_[k] ? (c + count_[k]) % count_[k] : c;
  };
  const auto is_in = [&](int at, std::size_t k) { return at >= 0 && at < count_[k]; };
  for (int z = 0; z < count_[2]; ++z)
    for (int y = 0; y < count_[1]; ++y)
      for (int x = 0; x < count_[0]; ++x) {
        const Extremes& here = moved[std::size_t((z * count_[1] + y) * count_[0] + x)];
        if (here[0] == nobody) continue;
        for (int n = 13; n < 27; ++n) {  // itself, and half of the others around it
          const int ox = next(x, n % 3 - 1, 0), oy = next(y, n / 3 % 3 - 1, 1), oz = next(z, n / 9 - 1, 2);
          if (!is_in(ox, 0) || !is_in(oy, 1) || !is_in(oz, 2)) continue;
          const Extremes& there = moved[std::size_t((oz * count_[1] + oy) * count_[0] + ox)];
          if (there[0] != nobody) apart = std::max(apart, square_apart(here, there));
        }
      }
  return {std::sqrt(apart), std::sqrt(moved[blocks][0])};
}

}  // namespace polybed::dem
