#include "fluid/viscous_stress.hpp"

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "core/vectors.hpp"
#include "fluid/density.hpp"
#include "fluid/face_stress.hpp"

namespace polybed::fluid {

using core::face_mean;
using core::Index;

namespace {

template <std::size_t dimensions, class Density>
void add_with(const Density& density, const core::Grid& grid, const Boundaries& boundaries, const FluidState& fluid,
              double viscosity, core::FaceField& acceleration) {
  const double* eps = fluid.voidage.data();
  core::for_each_axis<dimensions>([&](auto axis) __attribute__((always_inline)) {
    const FaceStress<dimensions, axis> stress(grid, fluid.voidage, fluid.velocity);
    const Index s = grid.stride(int(axis));
    double* rate = acceleration[axis].data();
    core::for_each_row(grid, boundaries.moving_faces(int(axis), true), [&](Index begin, Index end) {
#pragma GCC ivdep
      for (Index c = begin; c < end; ++c)
        rate[c] +=
            viscosity / density.on_face(c, s) * stress.divergence(c) / std::max(face_mean(eps, c, s), voidage_floor);
    });
  });
}

}  // namespace

void add_viscous_stress(const core::Grid& grid, const Boundaries& boundaries, const FluidState& fluid,
                        const relevance::FluidConstants& constants, core::FaceField& acceleration) {
  with_density(fluid, constants.density, [&]<class Density>(const Density& local) {
    if (grid.dimensions == 2)
      core::in_vectors<add_with<2, Density>>(local, grid, boundaries, fluid, constants.viscosity, acceleration);
    else
      core::in_vectors<add_with<3, Density>>(local, grid, boundaries, fluid, constants.viscosity, acceleration);
  });
}

}  // namespace polybed::fluid
