#include "tfm/granular_temperature.hpp"

#include <algorithm>

#include "core/operators.hpp"
#include "tfm/solids_viscosity.hpp"

namespace polybed::tfm {

using core::Index;

namespace {

/// Adds -U.grad theta as -div(U theta) + theta div U with theta from upwind on faces.
template <class Face>
void convect(const core::Grid& grid, const core::Field& temperature, const core::FaceField& velocity,
             core::Field& rate) {
  const double* theta = temperature.data();
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const double* u = velocity[std::size_t(axis)].data();
    const Index s = grid.stride(axis);
    const double per_length = 1 / grid.spacing[std::size_t(axis)];
    core::for_each_row(grid, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c)
        rate[std::size_t(c)] -= per_length * (u[c + s] * (Face::at(theta, c + s, s, u[c + s]) - theta[c]) -
                                              u[c] * (Face::at(theta, c, s, u[c]) - theta[c]));
    });
  }
}

}  // namespace

void add_temperature_transport(const Constants& constants, const fluid::Boundaries& boundaries, Scheme scheme,
                               Fields& fields, core::FaceField& flux) {
  const core::Grid& grid = constants.grid;
  for (std::size_t j = 0; j < constants.species(); ++j) {
    core::Field &theta = fields.solids.temperature[j], &rate = fields.solids.temperature_rate[j];
    core::Field& conductivity = fields.granular.conductivity[j];
    boundaries.fill_cells(theta);
    boundaries.fill_cells(conductivity);
    if (scheme == Scheme::limited)
      convect<core::LimitedFace>(grid, theta, fields.solids.velocity[j], rate);
    else
      convect<core::UpwindFace>(grid, theta, fields.solids.velocity[j], rate);
    const double* phi = fields.solids.fraction[j].data();
    const double floor = diffusion_floor(constants, j);
    for (int axis = 0; axis < grid.dimensions; ++axis) {
      core::Field& out = flux[std::size_t(axis)];
      std::fill(out.begin(), out.end(), 0.0);
      const Index s = grid.stride(axis);
      const double* k = conductivity.data();
      const double scale = 0.5 / grid.spacing[std::size_t(axis)];
      core::for_each_row(grid, core::interior_faces(grid, axis), [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c)
          out[std::size_t(c)] = scale * (std::max(phi[c - s], 0.0) * k[c - s] + std::max(phi[c], 0.0) * k[c]) *
                                (theta[std::size_t(c)] - theta[std::size_t(c - s)]);
      });
      boundaries.join(out, axis);
      const double per_length = 2 / (3 * constants.density[j] * grid.spacing[std::size_t(axis)]);
      core::for_each_row(grid, [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c)
          rate[std::size_t(c)] +=
              per_length * (out[std::size_t(c + s)] - out[std::size_t(c)]) / (std::max(phi[c], 0.0) + floor);
      });
    }
  }
}

}  // namespace polybed::tfm
