#include "fluid/viscous_stress.hpp"

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "core/numerics/ranks.hpp"
#include "core/vectors.hpp"
#include "fluid/convection.hpp"
#include "fluid/density.hpp"
#include "fluid/face_stress.hpp"

namespace polybed::fluid {

using core::face_mean;
using core::Index;

namespace {

template <std::size_t dimensions, class Metric, class Density>
void add_with(const Metric& metric, const Density& density, const core::Grid& grid, const Boundaries& boundaries,
              const FluidState& fluid, const core::FaceField& velocity, double viscosity,
              core::FaceField& acceleration) {
  const double* eps = fluid.voidage.data();
  core::for_each_axis<dimensions>([&](auto axis) __attribute__((always_inline)) {
    const FaceStress<dimensions, axis, Metric> stress(metric, grid, fluid.voidage, velocity);
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

/// Friction of no-slip walls that do not follow the grid. \param viscosity  kinematic, m2/s
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

/// Half of a velocity's coefficient in its own equation, over the kinematic viscosity. Cells of its momentum are
/// coupled by the mean open share of their common faces.
double rate_of_face(const core::Grid& grid, std::size_t a, Index f) {
  const core::Metric& metric = *grid.metric;
  const auto at = std::size_t(f), low = std::size_t(f - grid.stride(int(a)));
  double rate = metric.wall[a][at] / 4;
  for (std::size_t b = 0; b < std::size_t(grid.dimensions); ++b) {
    const auto next = std::size_t(grid.stride(int(b)));
    const core::Field& open = metric.open[b];
    const auto within = [&](std::size_t c) {
      return metric.volume[c] * metric.per_length[b][c] * metric.per_length[b][c];
    };
    const auto through = [&](std::size_t f, std::size_t edge) { return open[f] * metric.per_distance[b][edge]; };
    const double both = b == a ? within(low) + within(at)
                               : 0.5 * (through(low, at) + through(at, at) + through(low + next, at + next) +
                                        through(at + next, at + next));
    rate += 0.5 * both * metric.per_volume_on[a][at] / (grid.spacing[b] * grid.spacing[b]);
  }
  return rate;
}

}  // namespace

double viscous_rate(const core::Grid& grid) {
  double most = 0;
  if (!grid.metric) {
    for (int axis = 0; axis < grid.dimensions; ++axis)
      most += 1 / (grid.spacing[std::size_t(axis)] * grid.spacing[std::size_t(axis)]);
    return most;
  }
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    core::for_each_row(grid, core::interior_faces(grid, axis), [&](Index begin, Index end) {
      for (Index f = begin; f < end; ++f)
        if (grid.metric->open[a][std::size_t(f)] > 0) most = std::max(most, rate_of_face(grid, a, f));
    });
  }
  return core::greatest_of_ranks(grid, most);
}

void add_viscous_stress(const core::Grid& grid, const Boundaries& boundaries, const FluidState& fluid,
                        const relevance::FluidConstants& constants, core::FaceField& acceleration) {
  const bool inner = grid.metric && grid.metric->walls;
  const core::FaceField along_walls = inner ? along_walls_inside(grid, boundaries, fluid.velocity) : core::FaceField();
  const core::FaceField& velocity = inner ? along_walls : fluid.velocity;
  with_density(fluid, constants.density, [&]<class Density>(const Density& local) {
    core::with_metric(grid, [&]<class Metric>(const Metric& metric) {
      if (grid.dimensions == 2)
        core::in_vectors<add_with<2, Metric, Density>>(metric, local, grid, boundaries, fluid, velocity,
                                                       constants.viscosity, acceleration);
      else
        core::in_vectors<add_with<3, Metric, Density>>(metric, local, grid, boundaries, fluid, velocity,
                                                       constants.viscosity, acceleration);
    });
  });
  if (grid.metric)
    subtract_wall_friction(grid, boundaries, fluid, constants.viscosity / constants.density, acceleration);
}

}  // namespace polybed::fluid
