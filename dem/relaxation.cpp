// Pushes random particles apart until none overlap.
#include "dem/hard_spheres.hpp"

#include <algorithm>
#include <cmath>

#include "core/interrupt.hpp"
#include "core/numerics/random.hpp"
#include "dem/contacts/batch.hpp"

namespace polybed::dem {

namespace {

/// Number of listings of pairs, and of pushes per listing, with gaps.
constexpr int listings = 3, rounds = 20;
/// The same limits for the second phase, without gaps.
constexpr int last_listings = 1000, last_rounds = 5;
/// Remaining overlap if gaps are impossible, over the smaller radius; and the listings after which it is accepted.
constexpr double left_over = 1e-3;
constexpr int patience = 20;

struct Push {
  std::int32_t first, second, image;
  float share, distance;  ///< of the displacement for the first; m, wanted between the centres
};

/// The listed pairs, each with the distance for its radii and its number. Pairs of one particle are adjacent in the
/// list; here they are separated, so that no push waits for the previous one.
template <class Distance>
void fill(std::vector<Push>& pushes, const HardSpheres& spheres, const Distance& distance) {
  constexpr std::size_t side = 32;
  const std::vector<Contacts::Pair>& pairs = spheres.pairs();
  pushes.clear();
  const auto add = [&](std::size_t n) {
    const Contacts::Pair& pair = pairs[n];
    const double one = spheres.inverse_mass(pair.first), other = spheres.inverse_mass(pair.second);
    pushes.push_back({pair.first, pair.second, pair.image, float(one / (one + other)), float(distance(pair))});
  };
  const std::size_t blocks = pairs.size() / (side * side);
  for (std::size_t block = 0; block < blocks; ++block)
    for (std::size_t column = 0; column < side; ++column)
      for (std::size_t row = 0; row < side; ++row) add((block * side + row) * side + column);
  for (std::size_t n = blocks * side * side; n < pairs.size(); ++n) add(n);
}

/// Two coinciding centres separate upward.
void push(Place& a, Place& b, const Vector& d, const Push& p) {
  const double r = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), way = double(p.distance) - r;
  const Vector normal = r > 0 ? Vector{d[0] / r, d[1] / r, d[2] / r} : Vector{0, 1, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    a.x[k] += double(p.share) * way * normal[k];
    b.x[k] -= (1 - double(p.share)) * way * normal[k];
  }
}

void push_all(HardSpheres& spheres, const std::vector<Push>& pushes) {
  std::vector<Place>& place = spheres.places();
  for (const Push& p : pushes) {
    Place &a = place[std::size_t(p.first)], &b = place[std::size_t(p.second)];
    const Vector& shift = spheres.shift(p.image);
    const Vector d{a.x[0] - b.x[0] - shift[0], a.x[1] - b.x[1] - shift[1], a.x[2] - b.x[2] - shift[2]};
    if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < double(p.distance) * double(p.distance)) push(a, b, d, p);
  }
  const auto& bounds = spheres.bounds();
  POLYBED_INDEPENDENT
  for (std::size_t i = 0; i < place.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) place[i].x[k] = std::clamp(place[i].x[k], bounds[i].low[k], bounds[i].high[k]);
  if (bounds.empty() || !(bounds.front().round || bounds.front().walls)) return;
  for (std::size_t i = 0; i < place.size(); ++i) bounds[i].move_within_side(place[i].x);
}

double touching(HardSpheres& spheres, const Contacts::Pair& pair) {
  return spheres.places()[std::size_t(pair.first)].radius + spheres.places()[std::size_t(pair.second)].radius;
}

}  // namespace

double push_apart(HardSpheres& spheres, double gap) {
  std::vector<Push> pushes;
  for (int n = 0; n < listings; ++n) {
    core::stop_if_wanted("particles were placed");
    spheres.list(2.5 * gap);
    fill(pushes, spheres, [&](const Contacts::Pair& pair) {
      const std::uint64_t number = std::uint64_t(pair.first) << 32 | std::uint64_t(pair.second);
      return touching(spheres, pair) + gap * core::uniform(0, 0, number);
    });
    for (int round = 0; round < rounds; ++round) push_all(spheres, pushes);
  }
  double overlap = 1;
  for (int n = 0; n < last_listings; ++n) {
    core::stop_if_wanted("particles were placed");
    spheres.list(1.5 * gap);
    overlap = spheres.greatest_overlap();
    if (overlap <= (n < patience ? 0 : left_over)) return 0;
    // A little further than needed, so that the last overlaps end soon.
    const double more = 1 + (n < patience ? 0.02 : 1.5 * left_over);
    fill(pushes, spheres, [&](const Contacts::Pair& pair) { return more * touching(spheres, pair); });
    for (int round = 0; round < last_rounds; ++round) push_all(spheres, pushes);
  }
  return overlap;
}

}  // namespace polybed::dem
