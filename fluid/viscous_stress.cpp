#include "fluid/viscous_stress.hpp"

#include <algorithm>

#include "core/operators.hpp"
#include "fluid/face_stress.hpp"

namespace polybed::fluid {

using core::face_mean;
using core::Index;

void add_viscous_stress(const core::Grid& grid, const Boundaries& boundaries, const FluidState& fluid,
                        const FluidConstants& constants, core::FaceField& acceleration) {
  const double kinematic = constants.viscosity / constants.density;
  const double* eps = fluid.voidage.data();
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const FaceStress stress(grid, fluid.voidage, fluid.velocity, axis);
    const Index s = grid.stride(axis);
    double* rate = acceleration[std::size_t(axis)].data();
    core::for_each_row(grid, boundaries.moving_faces(axis, true), [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c)
        rate[c] += kinematic * stress.divergence(c) / std::max(face_mean(eps, c, s), voidage_floor);
    });
  }
}

}  // namespace polybed::fluid
