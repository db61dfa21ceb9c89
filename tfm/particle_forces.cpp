#include "tfm/particle_forces.hpp"

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "core/vectors.hpp"
#include "fluid/density.hpp"

namespace polybed::tfm {

using core::face_mean;
using core::Index;

namespace {

void add_reaction_gradient(const Constants& constants, const fluid::Boundaries& boundaries, int axis, Fields& fields) {
  const Index s = constants.grid.stride(axis);
  core::for_each_row(constants.grid, boundaries.moving_faces(axis, false), [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      double sum = 0;
      for (std::size_t k = 0; k < constants.species(); ++k)
        sum += face_mean(fields.solids.fraction[k].data(), c, s) * fields.force.on_solids[k][std::size_t(c)];
      sum /= std::max(face_mean(fields.fluid.voidage.data(), c, s), fluid::voidage_floor);
      for (core::Field& force : fields.force.on_solids) force[std::size_t(c)] += sum;
    }
  });
}

template <class Density>
void share_loops(const Density& density, const Constants& constants, const fluid::Boundaries& boundaries, int axis,
                 Fields& fields) {
  const auto a = std::size_t(axis);
  const Index s = constants.grid.stride(axis);
  const double* eps = fields.fluid.voidage.data();
  double* fluid = fields.fluid_acceleration[a].data();
  for (std::size_t j = 0; j < constants.species(); ++j) {
    const double *force = fields.force.on_solids[j].data(), *phi = fields.solids.fraction[j].data();
    double* solid = fields.solids.acceleration[j][a].data();
    const double per_density = 1 / constants.density[j];
    core::for_each_row(constants.grid, boundaries.moving_faces(axis, false), [&](Index begin, Index end) {
#pragma GCC ivdep
      for (Index c = begin; c < end; ++c) {
        solid[c] += per_density * force[c];
        fluid[c] -= face_mean(phi, c, s) * force[c] /
                    (std::max(face_mean(eps, c, s), fluid::voidage_floor) * density.on_face(c, s));
      }
    });
  }
}

}  // namespace

void share_particle_forces(const Constants& constants, const fluid::Boundaries& boundaries, int axis, Fields& fields) {
  if (constants.form_b) add_reaction_gradient(constants, boundaries, axis, fields);
  fluid::with_density(fields.fluid, constants.fluid.density, [&]<class Density>(const Density& local) {
    core::in_vectors<share_loops<Density>>(local, constants, boundaries, axis, fields);
  });
}

}  // namespace polybed::tfm
