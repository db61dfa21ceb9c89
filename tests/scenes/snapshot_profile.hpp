// A profile of particles that are all at hand.
#pragma once

#include "core/output/particles.hpp"
#include "measures/particle_profile.hpp"

namespace polybed::measures {

inline ParticleExtremes extremes_of(const core::ParticleSnapshot& particles) {
  ParticleExtremes most;
  for (std::size_t i = 0; i < particles.id.size(); ++i)
    most.add(sphere_volume_below(particles.radius[i], 0, particles.radius[i]), particles.velocity[i]);
  return most;
}

inline ParticleSums particle_sums(const core::ParticleSnapshot& particles, std::size_t species, const Slabs& slabs,
                                  const ParticleExtremes& all) {
  ParticleAdder adder(species, slabs, all);
  for (std::size_t i = 0; i < particles.id.size(); ++i)
    adder.add(std::size_t(particles.species[i]), particles.radius[i], particles.position[i][1], particles.velocity[i]);
  return adder.take();
}

inline ParticleProfile particle_profile(const core::ParticleSnapshot& particles, std::size_t species,
                                        const Slabs& slabs) {
  return particle_profile(particle_sums(particles, species, slabs, extremes_of(particles)), species, slabs);
}

}  // namespace polybed::measures
