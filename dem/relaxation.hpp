// Random particles pushed apart until none overlap.
#pragma once

#include <vector>

#include "dem/box.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

/// Moves particles apart, lighter ones further, until none overlap by more than a thousandth of the smaller radius.
/// They grow meanwhile, so that the result is random and not crushed. The result depends on the input alone.
/// \param low, high  m, within which each particle stays as a whole, but for directions that are periodic
/// Throws core::CaseError if they do not fit.
void push_apart(std::vector<Particle>& particles, const std::vector<Vector>& low, const std::vector<Vector>& high,
                const Box& box, const Materials& materials);

}  // namespace polybed::dem
