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

template <std::size_t dimensions, class Metric, class Density>
void add_with(const Metric& metric, const Density& density, const core::Grid& grid, const Boundaries& boundaries,
              const FluidState& fluid, double viscosity, core::FaceField& acceleration) {
  const double* eps = fluid.voidage.data();
  core::for_each_axis<dimensions>([&](auto axis) __attribute__((always_inline)) {
    const FaceStress<dimensions, axis, Metric> stress(metric, grid, fluid.voidage, fluid.velocity);
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

/// No slip along walls that do not follow the grid. \param viscosity  kinematic, m2/s
void subtract_wall_friction(const core::Grid& grid, const Boundaries& boundaries, const FluidState& fluid,
                            double viscosity, core::FaceField& acceleration) {
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    const double *wall = grid.metric->wall[a].data(), *u = fluid.velocity[a].data();
    double* rate = acceleration[a].data();
    core::for_each_row(grid, boundaries.moving_faces(axis, true), [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) rate[c] -= viscosity * wall[c] * u[c];
    });
  }
}

}  // namespace

void add_viscous_stress(const core::Grid& grid, const Boundaries& boundaries, const FluidState& fluid,
                        const relevance::FluidConstants& constants, core::FaceField& acceleration) {
  with_density(fluid, constants.density, [&]<class Density>(const Density& local) {
    core::with_metric(grid, [&]<class Metric>(const Metric& metric) {
      if (grid.dimensions == 2)
        core::in_vectors<add_with<2, Metric, Density>>(metric, local, grid, boundaries, fluid, constants.viscosity,
                                                       acceleration);
      else
        core::in_vectors<add_with<3, Metric, Density>>(metric, local, grid, boundaries, fluid, constants.viscosity,
                                                       acceleration);
    });
  });
  if (grid.metric)
    subtract_wall_friction(grid, boundaries, fluid, constants.viscosity / constants.density, acceleration);
}

}  // namespace polybed::fluid
