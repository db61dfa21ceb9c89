// Random particles pushed apart until none overlap.
#pragma once

#include "dem/hard_spheres.hpp"

namespace polybed::dem {

/// Moves spheres apart, lighter ones further, until none overlap; in a bed near the densest by less than a thousandth
/// of the smaller radius. Until then each pair is held at a random gap, as in a fluid of hard spheres: pushed to
/// contact alone, most would end in contact.
/// \param gap  m, the largest
/// Throws core::StartError if they do not fit.
void push_apart(HardSpheres& spheres, double gap);

}  // namespace polybed::dem
