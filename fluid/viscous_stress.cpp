#include "fluid/viscous_stress.hpp"

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "fluid/density.hpp"
#include "fluid/face_stress.hpp"

namespace polybed::fluid {

using core::face_mean;
using core::Index;

namespace {

template <std::size_t dimensions, class Density>
POLYBED_ALL_VECTOR_WIDTHS [[gnu::flatten]] void add_with(const Density& density, const core::Grid& grid,
                                                         const Boundaries& boundaries, const FluidState& fluid,
                                                         double viscosity, core::FaceField& acceleration) {
  const double* eps = fluid.voidage.data();
  core::for_each_axis<dimensions>([&](auto axis) {
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
  with_density(fluid, constants.density, [&](const auto& local) {
    if (grid.dimensions == 2)
      add_with<2>(local, grid, boundaries, fluid, constants.viscosity, acceleration);
    else
      add_with<3>(local, grid, boundaries, fluid, constants.viscosity, acceleration);
  });
}

}  // namespace polybed::fluid
