#include "fluid/momentum.hpp"

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "core/vectors.hpp"
#include "fluid/density.hpp"

namespace polybed::fluid {

using core::face_mean;
using core::Field;
using core::Index;

void voidage(const Interphase& solids, Field& out) {
  std::fill(out.begin(), out.end(), 1.0);
  for (const Field& phi : solids.fraction)
    for (std::size_t c = 0; c < out.size(); ++c) out[c] -= phi[c];
}

namespace {

void fluid_velocity_loops(const core::Grid& grid, const Interphase& solids, FluidState& fluid) {
  const double* eps = fluid.voidage.data();
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    const Index s = grid.stride(axis);
    double* u = fluid.velocity[a].data();
    const double* flux = fluid.flux[a].data();
    core::for_each_row(grid, core::owned_faces(grid, axis), [&](Index begin, Index end) {
#pragma GCC ivdep
      for (Index c = begin; c < end; ++c) u[c] = flux[c];
      for (std::size_t j = 0; j < solids.species(); ++j) {
        const double *phi = solids.fraction[j].data(), *v = solids.velocity[j][a].data();
#pragma GCC ivdep
        for (Index c = begin; c < end; ++c) u[c] -= face_mean(phi, c, s) * v[c];
      }
#pragma GCC ivdep
      for (Index c = begin; c < end; ++c) u[c] /= std::max(face_mean(eps, c, s), voidage_floor);
    });
  }
}

template <class Form, class Density>
void subtract_exchange_with(const Density& density, const core::Grid& grid, const Boundaries& boundaries,
                            const Interphase& solids, const FluidState& fluid, core::FaceField& acceleration) {
  const double* eps = fluid.voidage.data();
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    const Index s = grid.stride(axis);
    const double* u = fluid.velocity[a].data();
    double* rate = acceleration[a].data();
    core::for_each_row(grid, boundaries.with_solids(boundaries.moving_faces(axis, true)), [&](Index begin, Index end) {
      for (std::size_t j = 0; j < solids.species(); ++j) {
        const double *phi = solids.fraction[j].data(), *b = solids.exchange[j].data(),
                     *v = solids.velocity[j][a].data();
#pragma GCC ivdep
        for (Index c = begin; c < end; ++c)
          rate[c] -= face_mean(phi, c, s) * Form::at(b, eps, c, s, u[c] - v[c]) * (u[c] - v[c]) /
                     (std::max(face_mean(eps, c, s), voidage_floor) * density.on_face(c, s));
      }
    });
  }
}

template <class Density>
void flux_rate_with(const Density& density, const core::Grid& grid, const Boundaries& boundaries,
                    const Interphase& solids, const FluidState& fluid, const core::FaceField& acceleration,
                    FluxRate& out) {
  const double* eps = fluid.voidage.data();
  const double alone = solids.carry_pressure ? 0 : 1;  // the fluid has the whole gradient, not its share
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    const Index s = grid.stride(axis);
    const double *u = fluid.velocity[a].data(), *a_f = acceleration[a].data();
    double *free = out.free[a].data(), *mobility = out.mobility[a].data();
    core::for_each_row(grid, boundaries.moving_faces(axis, true), [&](Index begin, Index end) {
#pragma GCC ivdep
      for (Index c = begin; c < end; ++c) {
        free[c] = face_mean(eps, c, s) * a_f[c];
        mobility[c] = std::max(face_mean(eps, c, s), alone) / density.on_face(c, s);
      }
    });
    core::for_each_row(grid, boundaries.with_solids(boundaries.moving_faces(axis, true)), [&](Index begin, Index end) {
      for (std::size_t j = 0; j < solids.species(); ++j) {
        const double *phi_rate = solids.fraction_rate[j].data(), *v = solids.velocity[j][a].data();
#pragma GCC ivdep
        for (Index c = begin; c < end; ++c) free[c] += (v[c] - u[c]) * face_mean(phi_rate, c, s);
      }
    });
    core::for_each_row(grid, boundaries.moving_faces(axis, false), [&](Index begin, Index end) {
      for (std::size_t j = 0; j < solids.species(); ++j) {
        const double *phi = solids.fraction[j].data(), *a_j = solids.acceleration[j][a].data();
        const double response = solids.response(j);
#pragma GCC ivdep
        for (Index c = begin; c < end; ++c) {
          free[c] += face_mean(phi, c, s) * a_j[c];
          mobility[c] += face_mean(phi, c, s) * response;
        }
      }
    });
  }
  for (const OpenFace& f : boundaries.open_faces()) {
    const auto in = std::size_t(f.inside), at = std::size_t(f.face);
    double mixture = std::max(eps[in], voidage_floor) * density.on_face(f.face, grid.stride(int(f.axis())));
    for (std::size_t j = 0; j < solids.species(); ++j) mixture += solids.fraction[j][in] * solids.density[j];
    const double mobility = out.mobility[f.axis()][at] = f.mobility(mixture);
    out.free[f.axis()][at] = f.convection(fluid.flux[f.axis()], fluid.velocity[f.axis()]) - mobility * f.rise;
  }
}

}  // namespace

void fluid_velocity(const core::Grid& grid, const Interphase& solids, FluidState& fluid) {
  core::in_vectors<fluid_velocity_loops>(grid, solids, fluid);
}

void subtract_exchange(const core::Grid& grid, const Boundaries& boundaries, const Interphase& solids,
                       const FluidState& fluid, double density, core::FaceField& acceleration) {
  with_density(fluid, density, [&]<class Density>(const Density& local) {
    with_form(solids, [&]<class Form>(Form) {
      core::in_vectors<subtract_exchange_with<Form, Density>>(local, grid, boundaries, solids, fluid, acceleration);
    });
  });
}

void flux_rate(const core::Grid& grid, const Boundaries& boundaries, const Interphase& solids, const FluidState& fluid,
               double density, const core::FaceField& acceleration, FluxRate& out) {
  with_density(fluid, density, [&]<class Density>(const Density& local) {
    core::in_vectors<flux_rate_with<Density>>(local, grid, boundaries, solids, fluid, acceleration, out);
  });
  boundaries.join(out.free, out.mobility);
}

}  // namespace polybed::fluid
