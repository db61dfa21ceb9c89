// The bed of particles as a profile, summed by every rank over its own particles: nothing is gathered.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dem/model.hpp"
#include "measures/particle_profile.hpp"

namespace polybed::dem {

struct BedSums {
  measures::ParticleProfile profile;
  std::vector<std::optional<double>> centre;  ///< mean height of the centres of a species, m
  std::vector<std::int64_t> number;           ///< of its particles
};

/// Collective: the same on every rank, and on any number of ranks to the bit.
[[nodiscard]] BedSums bed_sums(const Model& model, const measures::Slabs& slabs);

}  // namespace polybed::dem
