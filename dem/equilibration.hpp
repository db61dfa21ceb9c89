// Random moves of hard spheres until they are a fluid of hard spheres.
#pragma once

#include "dem/hard_spheres.hpp"

namespace polybed::dem {

/// Sweeps of Metropolis et al. (J. Chem. Phys. 21, 1953): each sphere in turn tries a random step and takes it if it
/// overlaps none. This leaves the statistics of a fluid of hard spheres as they are, and any others it brings there.
/// \param fraction  of solids
void equilibrate(HardSpheres& spheres, double least_diameter, double fraction, std::uint64_t seed);

}  // namespace polybed::dem
