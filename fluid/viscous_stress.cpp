#include "fluid/viscous_stress.hpp"

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "fluid/density.hpp"
#include "fluid/face_stress.hpp"

namespace polybed::fluid {

using core::face_mean;
using core::Index;

namespace {

template <class Density>
void add_with(const Density& density, const core::Grid& grid, const Boundaries& boundaries, const FluidState& fluid,
              double viscosity, core::FaceField& acceleration) {
  const double* eps = fluid.voidage.data();
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const FaceStress stress(grid, fluid.voidage, fluid.velocity, axis);
    const Index s = grid.stride(axis);
    double* rate = acceleration[std::size_t(axis)].data();
    core::for_each_row(grid, boundaries.moving_faces(axis, true), [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c)
        rate[c] +=
            viscosity / density.on_face(c, s) * stress.divergence(c) / std::max(face_mean(eps, c, s), voidage_floor);
    });
  }
}

}  // namespace

void add_viscous_stress(const core::Grid& grid, const Boundaries& boundaries, const FluidState& fluid,
                        const relevance::FluidConstants& constants, core::FaceField& acceleration) {
  with_density(fluid, constants.density,
               [&](const auto& local) { add_with(local, grid, boundaries, fluid, constants.viscosity, acceleration); });
}

}  // namespace polybed::fluid
