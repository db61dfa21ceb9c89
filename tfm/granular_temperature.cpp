#include "tfm/granular_temperature.hpp"

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "tfm/solids_viscosity.hpp"

namespace polybed::tfm {

using core::Index;

namespace {

/// Adds -U.grad theta as -div(U theta) + theta div U with upwind theta on faces.
template <class Face, class Metric>
void convect(const Metric& metric, const core::Grid& grid, const core::Field& temperature,
             const core::FaceField& velocity, core::Field& rate) {
  const double* theta = temperature.data();
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    const double* u = velocity[a].data();
    const Index s = grid.stride(axis);
    const double per_length = 1 / grid.spacing[a];
    const auto through = [&](Index f, double theta_here) {
      return metric.open(a, f) * u[f] * (Face::at(theta, f, s, u[f]) - theta_here);
    };
    core::for_each_row(grid, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c)
        rate[std::size_t(c)] -= metric.per_volume(c) * per_length * (through(c + s, theta[c]) - through(c, theta[c]));
    });
  }
}

/// Adds (2/3) div(k grad theta)/((phi + floor) rho), k = phi times conductivity; the species' flux is work space.
template <class Metric>
void conduct(const Metric& metric, const Constants& constants, const fluid::Boundaries& boundaries, std::size_t species,
             Fields& fields) {
  const core::Grid& grid = constants.grid;
  const double *phi = fields.solids.fraction[species].data(), *theta = fields.solids.temperature[species].data(),
               *k = fields.granular.conductivity[species].data();
  double* rate = fields.solids.temperature_rate[species].data();
  const double floor = diffusion_floor(constants, species);
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const Index s = grid.stride(axis);
    const double h = grid.spacing[std::size_t(axis)], half_per_length = 0.5 / h;
    core::Field& heat = fields.solids_flux[species][std::size_t(axis)];
    std::fill(heat.begin(), heat.end(), 0.0);
    core::for_each_row(grid, core::interior_faces(grid, axis), [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c)
        heat[std::size_t(c)] = metric.open(std::size_t(axis), c) * metric.per_distance(std::size_t(axis), c) *
                               half_per_length * (std::max(phi[c - s], 0.0) * k[c - s] + std::max(phi[c], 0.0) * k[c]) *
                               (theta[c] - theta[c - s]);
    });
    boundaries.join(heat, axis);
    const double scale = 2 / (3 * constants.density[species] * h);
    core::for_each_row(grid, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c)
        rate[c] += metric.per_volume(c) * scale * (heat[std::size_t(c + s)] - heat[std::size_t(c)]) /
                   (std::max(phi[c], 0.0) + floor);
    });
  }
}

}  // namespace

void add_temperature_transport(const Constants& constants, const fluid::Boundaries& boundaries, Scheme scheme,
                               Fields& fields) {
  for (std::size_t j = 0; j < constants.species(); ++j) {
    core::Field &theta = fields.solids.temperature[j], &rate = fields.solids.temperature_rate[j];
    boundaries.fill_cells(theta);
    boundaries.fill_cells(fields.granular.conductivity[j]);
    core::with_metric(constants.grid, [&](const auto& metric) {
      if (scheme == Scheme::limited)
        convect<core::LimitedFace>(metric, constants.grid, theta, fields.solids.velocity[j], rate);
      else
        convect<core::UpwindFace>(metric, constants.grid, theta, fields.solids.velocity[j], rate);
      conduct(metric, constants, boundaries, j, fields);
    });
  }
}

}  // namespace polybed::tfm
