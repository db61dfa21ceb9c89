#include "tfm/mixture.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/operators.hpp"
#include "core/vectors.hpp"

namespace polybed::tfm {

using core::face_mean;
using core::Field;
using core::Index;

namespace {

void composition_loops(const Constants& constants, Fields& fields) {
  const std::size_t cells = constants.grid.padded_size();
  Field& phi = fields.solids_fraction;
  Field& eps = fields.fluid.voidage;
  std::fill(phi.begin(), phi.end(), 0.0);
  std::fill(eps.begin(), eps.end(), composition_floor);
  for (const Field& phi_j : fields.solids.fraction)
    for (std::size_t c = 0; c < cells; ++c) {
      phi[c] += phi_j[c];
      eps[c] += std::max(phi_j[c], 0.0);
    }
  for (std::size_t c = 0; c < cells; ++c) eps[c] = 1 / eps[c];
  for (std::size_t j = 0; j < constants.species(); ++j) {
    const double* phi_j = fields.solids.fraction[j].data();
    const double floor = composition_floor * constants.bed_share[j];
    double* share = fields.share[j].data();
#pragma GCC ivdep
    for (std::size_t c = 0; c < cells; ++c) share[c] = (std::max(phi_j[c], 0.0) + floor) * eps[c];
  }
  for (std::size_t c = 0; c < cells; ++c) eps[c] = 1 - phi[c];
}

void superficial_slip_loops(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields) {
  const core::Grid& grid = constants.grid;
  const double* eps = fields.fluid.voidage.data();
  for (std::size_t j = 0; j < constants.species(); ++j) {
    double* slip = fields.slip_superficial[j].data();
    core::for_each_row(grid, boundaries.solids_cells(), [&](Index begin, Index end) {
      for (int axis = 0; axis < grid.dimensions; ++axis) {
        const Index s = grid.stride(axis);
        const double* u = fields.fluid.velocity[std::size_t(axis)].data();
        const double* v = fields.solids.velocity[j][std::size_t(axis)].data();
#pragma GCC ivdep
        for (Index c = begin; c < end; ++c) {
          const double w =
              0.5 * (face_mean(eps, c, s) * (u[c] - v[c]) + face_mean(eps, c + s, s) * (u[c + s] - v[c + s]));
          slip[c] = (axis == 0 ? 0.0 : slip[c]) + w * w;
        }
      }
#pragma GCC ivdep
      for (Index c = begin; c < end; ++c) slip[c] = std::sqrt(slip[c]);
    });
  }
}

}  // namespace

void composition(const Constants& constants, Fields& fields) { core::in_vectors<composition_loops>(constants, fields); }

void superficial_slip(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields) {
  core::in_vectors<superficial_slip_loops>(constants, boundaries, fields);
}

void weigh_slip_by_density(const Constants& constants, Fields& fields) {
  const double* density = fields.fluid.compression.density.data();
  const double per_density = 1 / constants.fluid.density;
  for (Field& slip : fields.slip_superficial)
    core::for_each_row(constants.grid, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) slip[std::size_t(c)] *= density[c] * per_density;
    });
}

}  // namespace polybed::tfm
