// Vorticity of the averaged fluid in cells.
#pragma once

#include "core/numerics/field.hpp"

namespace polybed::fluid {

/// omega = curl U, 1/s, in owned cells, by central differences over two cells; only the third component for a 2-D grid.
/// \param velocity  on faces, with its ghosts
void find_vorticity(const core::Grid& grid, const core::FaceField& velocity, std::array<core::Field, 3>& vorticity);

}  // namespace polybed::fluid
