// Vorticity of the averaged fluid in cells.
#pragma once

#include "core/numerics/field.hpp"

namespace polybed::fluid {

/// omega = curl U, 1/s, in owned cells, by central differences over two cells; of a 2-D grid its third component alone.
/// \param velocity  on faces, with its ghosts
void find_vorticity(const core::Grid& grid, const core::FaceField& velocity, std::array<core::Field, 3>& vorticity);

}  // namespace polybed::fluid
