#include "dem/hard_spheres.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace polybed::dem {

namespace {

Box without_shear(Box box) {
  box.shear_rate = 0;
  return box;
}

Region of_centre(const Region& region, double radius, const Box& box) {
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  Region bounds = region;
  bounds.of_sphere = radius;
  for (std::size_t k = 0; k < 3; ++k) {
    const bool free = box.periodic[k] && region.low[k] <= 0 && region.high[k] >= box.size[k];
    bounds.low[k] = free ? -nowhere : region.low[k] + radius;
    bounds.high[k] = free ? nowhere : region.high[k] - radius;
  }
  return bounds;
}

}  // namespace

double Region::volume() const {
  const Region box = even();
  const double between = (high[0] - low[0]) * (box.high[1] - box.low[1]) * (high[2] - low[2]);
  return round ? std::numbers::pi / 4 * between : between;
}

Region Region::even() const {
  Region box = *this;
  if (side)
    for (Vector* corner : {&box.low, &box.high}) (*corner)[1] = side.even_height((*corner)[1]);
  return box;
}

double Region::distance_from_axis(const Vector& x) const {
  const auto [dx, dz] = from_axis(x);
  return std::sqrt(dx * dx + dz * dz);
}

void Region::move_within_side(Vector& x) const {
  if (walls)
    if (const core::FromWall wall = walls->nearest(x); wall.distance < of_sphere)
      for (std::size_t k = 0; k < 3; ++k) x[k] += (of_sphere - wall.distance) * wall.away[k];
  if (!round) return;
  if (side) return side.move_inside(x, of_sphere, low[1], high[1]);
  const auto [dx, dz] = from_axis(x);
  const double away = distance_from_axis(x), beyond = away - radius();
  if (!(beyond > 0)) return;
  x[0] -= beyond / away * dx;
  x[2] -= beyond / away * dz;
}

/// Maps squares about the axis to circles: a point keeps its relative place along the side of its square.
Vector Region::mapped_within_side(const Vector& x) const {
  const auto [dx, dz] = from_axis(x);
  const double height = side ? side.height_of(x[1]) : x[1], drawn_in = side ? side.narrowing(height) : 1;
  if (dx == 0 && dz == 0) return {x[0], height, x[2]};
  const bool along_x = std::abs(dx) > std::abs(dz);
  const double circle = drawn_in * (along_x ? dx : dz);
  const double angle =
      along_x ? std::numbers::pi / 4 * (dz / dx) : std::numbers::pi / 2 - std::numbers::pi / 4 * (dx / dz);
  return {x[0] - dx + circle * std::cos(angle), height, x[2] - dz + circle * std::sin(angle)};
}

HardSpheres::HardSpheres(const std::vector<Particle>& all, const std::vector<Region>& region, const Box& box,
                         const Materials& materials)
    : box_(without_shear(box)), materials_(materials), images_(box_, 0, 0) {
  for (const Particle& p : all) particles_.add(p);
  particles_.owned = particles_.size();
  order_ = NeighbourSearch(box_, materials_, 0, 0).order(particles_);
  for (std::size_t n = 0; n < all.size(); ++n) {
    const auto i = std::size_t(order_[n]);
    particles_.set(n, all[i]);
    particles_.id[n] = std::int64_t(n);
    bounds_.push_back(of_centre(region[i], all[i].place.radius, box_));
  }
}

void HardSpheres::list(double reach) {
  for (Place& p : particles_.place) p.x = box_.wrapped(p.x);
  NeighbourSearch(box_, materials_, reach, 0).find_pairs(particles_, 0, {}, {true, true, true}, near_);
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
