#include "tfm/particle_forces.hpp"

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "core/vectors.hpp"
#include "fluid/density.hpp"

namespace polybed::tfm {

using core::face_mean;
using core::Index;

namespace {

void add_reaction_gradient(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields) {
  const auto dimensions = std::size_t(constants.grid.dimensions);
  core::for_each_row(constants.grid, boundaries.solids_cells(), [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c)
      for (std::size_t a = 0; a < dimensions; ++a) {
        double sum = 0;
        for (std::size_t k = 0; k < constants.species(); ++k)
          sum += fields.solids.fraction[k][c] * fields.force.on_solids[k * dimensions + a][c];
        sum /= std::max(fields.fluid.voidage[c], fluid::voidage_floor);
        for (std::size_t j = 0; j < constants.species(); ++j) fields.force.on_solids[j * dimensions + a][c] += sum;
      }
  });
}

template <class Density>
void share_loops(const Density& density, const Constants& constants, const fluid::Boundaries& boundaries,
                 Fields& fields) {
  const core::Grid& grid = constants.grid;
  const double* eps = fields.fluid.voidage.data();
  for (std::size_t j = 0; j < constants.species(); ++j)
    for (int axis = 0; axis < grid.dimensions; ++axis) {
      const auto a = std::size_t(axis);
      const Index s = grid.stride(axis);
      const double *force = fields.force.on_solids[j * std::size_t(grid.dimensions) + a].data(),
                   *phi = fields.solids.fraction[j].data();
      double *solid = fields.solids.acceleration[j][a].data(), *fluid = fields.fluid_acceleration[a].data();
      const double per_density = 1 / constants.density[j];
      core::for_each_row(grid, boundaries.moving_faces(axis, false), [&](Index begin, Index end) {
#pragma GCC ivdep
        for (Index c = begin; c < end; ++c) {
          const double f = face_mean(force, c, s);
          solid[c] += per_density * f;
          fluid[c] -=
              face_mean(phi, c, s) * f / (std::max(face_mean(eps, c, s), fluid::voidage_floor) * density.on_face(c, s));
        }
      });
    }
}

}  // namespace

void share_particle_forces(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields) {
  if (constants.form_b) add_reaction_gradient(constants, boundaries, fields);
  boundaries.fill_cells(fields.force.on_solids);
  fluid::with_density(fields.fluid, constants.fluid.density, [&]<class Density>(const Density& local) {
    core::in_vectors<share_loops<Density>>(local, constants, boundaries, fields);
  });
}

}  // namespace polybed::tfm
