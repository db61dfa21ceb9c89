// Random first places of particles, as even over large distances as those of hard spheres.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/hard_spheres.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

/// Places particles in a region, whatever their overlaps. Some lie anywhere; the others, in random order, each in a
/// part of the region as large as its share of the volume. Particles that all lay anywhere would be as uneven as an
/// ideal gas, and what is uneven over many diameters takes longest to even out.
void spread(std::vector<Particle*>& particles, const Region& region, std::uint64_t seed);

}  // namespace polybed::dem
