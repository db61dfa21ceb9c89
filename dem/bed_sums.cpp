#include "dem/bed_sums.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/messages.hpp"

namespace polybed::dem {

namespace {

/// What fixes the units of the sums, of all ranks.
struct Greatest {
  measures::ParticleExtremes of;
  double height = 0;  ///< m
};

Greatest greatest_of(const Model& model) {
  const Particles& particles = model.particles();
  std::vector<double> volume;
  for (const Species& s : model.materials().species())
    volume.push_back(measures::sphere_volume_below(s.radius, 0, s.radius));
  Greatest most;
  for (std::size_t i = 0; i < particles.owned; ++i) {
    most.of.add(volume[std::size_t(particles.species[i])], particles.motion[i].v);
    most.height = std::max(most.height, std::abs(particles.place[i].x[1]));
  }
  most.of.particles = model.particle_count();
  for (double* value : {&most.of.volume, &most.of.momentum, &most.of.energy, &most.height})
    *value = core::greatest_of_ranks(model.ranks(), *value);
  return most;
}

}  // namespace

BedSums bed_sums(const Model& model, const measures::Slabs& slabs) {
  const Particles& particles = model.particles();
  const std::size_t species = model.materials().species().size();
  const Greatest most = greatest_of(model);
  measures::ParticleAdder adder(species, slabs, most.of);
  std::vector<measures::SteadySum> height(species, {model.particle_count(), most.height});
  std::vector<std::int64_t> number(species, 0);
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const auto j = std::size_t(particles.species[i]);
    const Place& place = particles.place[i];
    adder.add(j, place.radius, place.x[1], particles.motion[i].v);
    height[j].add(place.x[1]);
    ++number[j];
  }
  measures::ParticleSums sums = adder.take();
  core::add_over_ranks(model.ranks(), sums.sum);
  std::vector<std::int64_t> heights;
  for (const measures::SteadySum& h : height) heights.push_back(h.units());
  core::add_over_ranks(model.ranks(), heights);
  core::add_over_ranks(model.ranks(), number);
  BedSums bed{measures::particle_profile(sums, species, slabs), {}, number};
  for (std::size_t j = 0; j < species; ++j)
    bed.centre.push_back(number[j] > 0 ? std::optional(height[j].value_of(heights[j]) / double(number[j]))
                                       : std::nullopt);
  return bed;
}

}  // namespace polybed::dem
