#include "dem/relaxation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/interrupt.hpp"
#include "core/start_error.hpp"
#include "dem/contacts/neighbours.hpp"

namespace polybed::dem {

namespace {

/// Overlap that is left, as a share of the smaller radius.
constexpr double left_over = 1e-3;

class Relaxation {
 public:
  Relaxation(std::vector<Particle>& all, const std::vector<Vector>& low, const std::vector<Vector>& high,
             const Box& box, const Materials& materials)
      : all_(all),
        low_(low),
        high_(high),
        box_(at_rest(box)),
        images_(box_, 0, 0),
        skin_(0.3 * materials.least_diameter()),
        search_(box_, materials, skin_) {
    for (const Particle& p : all_) particles_.add(p);
    particles_.owned = particles_.size();
  }

  /// Pushes particles apart whose radii are `size` times theirs. Returns the greatest overlap left, in radii.
  double push(double size, int rounds) {
    double worst = 0;  // so that the first round makes a list
    for (int round = 0; round < rounds; ++round) {
      core::stop_if_wanted("particles were placed");
      const bool fresh = worst < left_over || 2 * farthest() > skin_;
      if (fresh) list();
      worst = 0;
      for (const Contacts::Pair& pair : near_.pairs) {
        const double overlap = part(std::size_t(pair.first), std::size_t(pair.second), size);
        const double radius = std::min(particles_.place[std::size_t(pair.first)].radius,
                                       particles_.place[std::size_t(pair.second)].radius);
        worst = std::max(worst, overlap / radius);
      }
      for (std::size_t i = 0; i < particles_.size(); ++i) keep_inside(i, size);
      if (worst < left_over && fresh) break;
    }
    return worst;
  }

  void give_back() {
    for (std::size_t i = 0; i < all_.size(); ++i) all_[i].place.x = wrapped(particles_.place[i].x);
  }

 private:
  static Box at_rest(Box box) {
    box.shear_rate = 0;
    return box;
  }

  [[nodiscard]] Vector wrapped(Vector x) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (box_.periodic[k]) {
        x[k] -= std::floor(x[k] / box_.size[k]) * box_.size[k];
        if (x[k] >= box_.size[k]) x[k] = 0;
      }
    return x;
  }

  void list() {
    for (std::size_t i = 0; i < particles_.size(); ++i) particles_.place[i].x = wrapped(particles_.place[i].x);
    search_.find_pairs(particles_, 0, {}, {true, true, true}, near_);
    listed_ = particles_.place;
  }

  /// The greatest distance that a particle has come since the pairs were listed, m.
  [[nodiscard]] double farthest() const {
    double most = 0;
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      const Vector &x = particles_.place[i].x, &from = listed_[i].x;
      const double dx = x[0] - from[0], dy = x[1] - from[1], dz = x[2] - from[2];
      most = std::max(most, dx * dx + dy * dy + dz * dz);
    }
    return std::sqrt(most);
  }

  /// Moves two particles that overlap apart, a little further than need be, so that the last overlaps end soon.
  double part(std::size_t i, std::size_t j, double size) {
    Vector &a = particles_.place[i].x, &b = particles_.place[j].x;
    const Vector away{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    const Vector d = images_.seen(away, images_.nearest(away));
    const double r = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double wanted = size * (particles_.place[i].radius + particles_.place[j].radius);
    if (r >= wanted) return 0;
    const double light = particles_.motion[i].inverse_mass, other = particles_.motion[j].inverse_mass;
    const double step = (wanted - r) * (1 + left_over) + 0.1 * left_over * wanted;
    const double share = light / (light + other);
    for (std::size_t k = 0; k < 3; ++k) {
      // Two centres at one place part upward.
      const double n = r > 0 ? d[k] / r : (k == 1 ? 1.0 : 0.0);
      a[k] += share * step * n;
      b[k] -= (1 - share) * step * n;
    }
    return wanted - r;
  }

  void keep_inside(std::size_t i, double size) {
    Place& p = particles_.place[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const bool free = box_.periodic[k] && low_[i][k] <= 0 && high_[i][k] >= box_.size[k];
      if (!free) p.x[k] = std::clamp(p.x[k], low_[i][k] + size * p.radius, high_[i][k] - size * p.radius);
    }
  }

  std::vector<Particle>& all_;
  const std::vector<Vector>&low_, &high_;
  Box box_;
  Images images_;
  double skin_;
  NeighbourSearch search_;
  Particles particles_;
  Contacts near_;
  std::vector<Place> listed_;
};

}  // namespace

void push_apart(std::vector<Particle>& particles, const std::vector<Vector>& low, const std::vector<Vector>& high,
                const Box& box, const Materials& materials) {
  if (particles.empty()) return;
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (!box.periodic[k] && high[i][k] - low[i][k] < 2 * particles[i].place.radius)
        throw core::StartError(fmt::format("column.size: {:.4g} m has no room for a particle of diameter {:.4g} m",
                                           high[i][k] - low[i][k], 2 * particles[i].place.radius));
  Relaxation relaxation(particles, low, high, box, materials);
  for (const double size : {0.7, 0.8, 0.9, 0.95}) relaxation.push(size, 20);
  const double worst = relaxation.push(1, 5000);
  if (worst >= left_over)
    throw core::StartError(fmt::format(
        "bed: the particles do not fit: some still overlap by {:.2g} of their radius; give the bed more room "
        "(column.size, bed.start_solids_fraction)",
        worst));
  relaxation.give_back();
}

}  // namespace polybed::dem
