#include "dem/hard_spheres.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polybed::dem {

namespace {

Box without_shear(Box box) {
  box.shear_rate = 0;
  return box;
}

Region of_centre(const Region& region, double radius, const Box& box) {
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  Region bounds;
  for (std::size_t k = 0; k < 3; ++k) {
    const bool free = box.periodic[k] && region.low[k] <= 0 && region.high[k] >= box.size[k];
    bounds.low[k] = free ? -nowhere : region.low[k] + radius;
    bounds.high[k] = free ? nowhere : region.high[k] - radius;
  }
  return bounds;
}

}  // namespace

HardSpheres::HardSpheres(const std::vector<Particle>& all, const std::vector<Region>& region, const Box& box,
                         const Materials& materials)
    : box_(without_shear(box)), materials_(materials), images_(box_, 0, 0) {
  for (const Particle& p : all) particles_.add(p);
  particles_.owned = particles_.size();
  order_ = NeighbourSearch(box_, materials_, 0).order(particles_);
  for (std::size_t n = 0; n < all.size(); ++n) {
    const auto i = std::size_t(order_[n]);
    particles_.set(n, all[i]);
    particles_.id[n] = std::int64_t(n);
    bounds_.push_back(of_centre(region[i], all[i].place.radius, box_));
  }
}

void HardSpheres::list(double reach) {
  for (Place& p : particles_.place) p.x = box_.wrapped(p.x);
  NeighbourSearch(box_, materials_, reach).find_pairs(particles_, 0, {}, {true, true, true}, near_);
}

double HardSpheres::greatest_overlap() const {
  double worst = 0;
  for (const Contacts::Pair& pair : near_.pairs) {
    const Place &a = particles_.place[std::size_t(pair.first)], &b = particles_.place[std::size_t(pair.second)];
    const Vector& s = shift(pair.image);
    const double x = a.x[0] - b.x[0] - s[0], y = a.x[1] - b.x[1] - s[1], z = a.x[2] - b.x[2] - s[2];
    const double square = x * x + y * y + z * z, touch = a.radius + b.radius;
    if (square < touch * touch) worst = std::max(worst, (touch - std::sqrt(square)) / std::min(a.radius, b.radius));
  }
  return worst;
}

void HardSpheres::give_back(std::vector<Particle>& all) const {
  for (std::size_t n = 0; n < all.size(); ++n)
    all[std::size_t(order_[n])].place.x = box_.wrapped(particles_.place[n].x);
}

}  // namespace polybed::dem
