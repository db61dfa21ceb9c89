// Convection of a velocity by itself.
#pragma once

#include "fluid/boundaries.hpp"

namespace polybed::fluid {

/// Sets the acceleration of a phase to -(U.grad)U on its moving faces, m/s2, and to 0 elsewhere.
/// \param limited   second order with limited slopes; else of first order, upwind
/// \param of_fluid  whether the outlet's faces move
/// \param velocity  U, m/s, ghosts filled
void convection(const core::Grid& grid, const Boundaries& boundaries, bool limited, bool of_fluid,
                const core::FaceField& velocity, core::FaceField& acceleration);

}  // namespace polybed::fluid
