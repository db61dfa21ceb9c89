#include "measures/particle_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace polybed::measures {

namespace {

double volume_of(double radius) { return sphere_volume_below(radius, 0, radius); }

/// A power of two such that `count` numbers of at most `most` sum to less than 2^62 of it.
double unit_for(std::int64_t count, double most) {
  const double bound = double(count) * most;
  return bound > 0 ? std::ldexp(1.0, std::ilogb(bound) + 1 - 62) : 1.0;
}

double speed_squared(const std::array<double, 3>& u) { return u[0] * u[0] + u[1] * u[1] + u[2] * u[2]; }

}  // namespace

double sphere_volume_below(double radius, double centre, double plane) {
  const double h = std::clamp(plane - (centre - radius), 0.0, 2 * radius);
  return std::numbers::pi * h * h * (3 * radius - h) / 3;
}

void ParticleExtremes::add(double volume_of_one, const std::array<double, 3>& u) {
  ++particles;
  volume = std::max(volume, volume_of_one);
  for (const double component : u) momentum = std::max(momentum, volume_of_one * std::abs(component));
  energy = std::max(energy, volume_of_one * speed_squared(u));
}

ParticleAdder::ParticleAdder(std::size_t species, const Slabs& slabs, const ParticleExtremes& all)
    : slabs_(slabs), thickness_(slabs.thickness()) {
  const double momentum = unit_for(all.particles, all.momentum);
  sums_.unit = {unit_for(all.particles, all.volume), momentum, momentum, momentum, unit_for(all.particles, all.energy)};
  for (std::size_t q = 0; q < per_unit_.size(); ++q) per_unit_[q] = 1 / sums_.unit[q];
  sums_.sum.assign(species * ParticleSums::quantities * slabs.count, 0);
}

ParticleAdder::Reach ParticleAdder::reach_of(double radius, double centre) const {
  const auto count = std::int64_t(slabs_.count);
  std::int64_t least = -count, most = 2 * count - 1;  // one column down and up
  if (!slabs_.joined) {
    const bool inside = centre >= 0 && centre <= slabs_.height;
    least = inside ? 0 : -1;  // everything beyond an end is one slab
    most = inside ? count - 1 : count;
    if (inside && 2 * radius <= slabs_.height) centre = std::clamp(centre, radius, slabs_.height - radius);
  }
  const auto slab_at = [&](double height) {
    return std::int64_t(std::clamp(std::floor(height / thickness_), double(least), double(most)));
  };
  return {centre, slab_at(centre - radius), slab_at(centre + radius)};
}

void ParticleAdder::add(std::size_t species, double radius, double centre, const std::array<double, 3>& u) {
  if (radius != radius_) {
    radius_ = radius;
    whole_ = std::llrint(volume_of(radius) * per_unit_[0]);
  }
  const auto count = std::int64_t(slabs_.count);
  std::int64_t* sum = &sums_.sum[species * ParticleSums::quantities * slabs_.count];
  const Reach reach = reach_of(radius, centre);
  std::int64_t below = 0;
  for (std::int64_t n = reach.first; n <= reach.last; ++n) {
    const double plane = double(n + 1) * thickness_;
    // Round the cap below, so that the parts sum to the rounded sphere.
    const std::int64_t up_to_here =
        n == reach.last ? whole_ : std::llrint(sphere_volume_below(radius, reach.centre, plane) * per_unit_[0]);
    const std::int64_t part = up_to_here - below;
    below = up_to_here;
    const int columns_up = n < 0 ? -1 : (n < count ? 0 : 1);
    if (columns_up != 0 && !slabs_.joined) continue;
    const auto k = std::size_t(n - columns_up * count);
    const std::array<double, 3> seen{u[0] - columns_up * slabs_.image_speed, u[1], u[2]};
    const double volume = double(part) * sums_.unit[0];
    sum[k] += part;
    for (std::size_t a = 0; a < 3; ++a)
      sum[(a + 1) * slabs_.count + k] += std::llrint(volume * seen[a] * per_unit_[a + 1]);
    sum[4 * slabs_.count + k] += std::llrint(volume * speed_squared(seen) * per_unit_[4]);
  }
}

ParticleProfile particle_profile(const ParticleSums& sums, std::size_t species, const Slabs& slabs) {
  ParticleProfile profile;
  profile.solids.slab = slabs.thickness();
  profile.solids.areas = slabs.areas;
  const std::vector<double> empty(slabs.count, 0.0);
  profile.solids.fraction = profile.velocity = profile.temperature = std::vector(species, empty);
  for (std::size_t j = 0; j < species; ++j)
    for (std::size_t k = 0; k < slabs.count; ++k) {
      std::array<double, ParticleSums::quantities> total;
      for (std::size_t q = 0; q < total.size(); ++q)
        total[q] = double(sums.sum[(j * total.size() + q) * slabs.count + k]) * sums.unit[q];
      const auto& [volume, x, y, z, energy] = total;
      profile.solids.fraction[j][k] =
          volume / ((slabs.areas.empty() ? slabs.area : slabs.areas[k]) * slabs.thickness());
      if (!(volume > 0)) continue;
      const double mean_squared = speed_squared({x / volume, y / volume, z / volume});
      profile.velocity[j][k] = y / volume;
      // Rounding can make the difference negative for particles that move as one.
      profile.temperature[j][k] = std::max(energy / volume - mean_squared, 0.0) / 3;
    }
  return profile;
}

SteadySum::SteadySum(std::int64_t count, double most) : per_unit_(1 / unit_for(count, most)) {}

}  // namespace polybed::measures
