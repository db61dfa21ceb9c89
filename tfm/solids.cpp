#include "tfm/solids.hpp"

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "core/vectors.hpp"
#include "tfm/fraction_face.hpp"

namespace polybed::tfm {

using core::face_mean;
using core::Field;
using core::Index;

namespace {

/// Calls body(species, axis, begin, end) for all rows of faces on which solids move.
template <class Body>
void for_each_solids_row(const Constants& constants, const fluid::Boundaries& boundaries, Body&& body) {
  for (std::size_t j = 0; j < constants.species(); ++j)
    for (int axis = 0; axis < constants.grid.dimensions; ++axis)
      core::for_each_row(constants.grid, boundaries.moving_faces(axis, false),
                         [&](Index begin, Index end) { body(j, axis, begin, end); });
}

template <class Face>
void solids_flux(const core::Grid& grid, const fluid::Boundaries& boundaries, const Field& fraction,
                 const core::FaceField& velocity, core::FaceField& flux) {
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const Index s = grid.stride(axis);
    const double *phi = fraction.data(), *u = velocity[std::size_t(axis)].data();
    double* out = flux[std::size_t(axis)].data();
    core::for_each_row(grid, boundaries.moving_faces_of_cells(axis, false), [&](Index begin, Index end) {
#pragma GCC ivdep
      for (Index c = begin; c < end; ++c) out[c] = u[c] * Face::at(phi, c, s, u[c]);
    });
  }
}

/// Recomputes the faces in a list, first order.
void redo_upwind(const core::Grid& grid, const FaceList& faces, const Field& fraction, const core::FaceField& velocity,
                 core::FaceField& flux) {
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    const double *phi = fraction.data(), *u = velocity[a].data();
    double* out = flux[a].data();
    for (const Index c : faces[a]) out[c] = u[c] * core::UpwindFace::at(phi, c, grid.stride(axis), u[c]);
  }
}

/// Subtracts the flux of a species from the mixture's.
void subtract(const core::FaceField& flux, core::FaceField& from) {
  for (std::size_t a = 0; a < flux.size(); ++a)
    for (std::size_t f = 0; f < flux[a].size(); ++f) from[a][f] -= flux[a][f];
}

template <class Form>
void add_exchange_loops(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields) {
  for_each_solids_row(constants, boundaries, [&](std::size_t j, int axis, Index begin, Index end) {
    const auto d = std::size_t(axis);
    const Index s = constants.grid.stride(axis);
    const double *b = fields.solids.exchange[j].data(), *u = fields.fluid.velocity[d].data(),
                 *v = fields.solids.velocity[j][d].data(), *eps = fields.fluid.voidage.data();
    double* a = fields.solids.acceleration[j][d].data();
    const double per_density = 1 / constants.density[j];
#pragma GCC ivdep
    for (Index c = begin; c < end; ++c) a[c] += Form::at(b, eps, c, s, u[c] - v[c]) * per_density * (u[c] - v[c]);
  });
}

void subtract_stress_loops(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields) {
  const double *p = fields.stress.pressure.data(), *phi = fields.solids_fraction.data();
  for_each_solids_row(constants, boundaries, [&](std::size_t j, int axis, Index begin, Index end) {
    const Index s = constants.grid.stride(axis);
    double* a = fields.solids.acceleration[j][std::size_t(axis)].data();
    double scale = 1 / (constants.grid.spacing[std::size_t(axis)] * constants.density[j]);
    const Field& work = fields.stress.upwind_work[std::size_t(axis)];
    const double* per_distance = nullptr;
    if (constants.grid.graded(axis)) per_distance = constants.grid.metric->per_distance[std::size_t(axis)].data();
    if (per_distance && axis == 0) {  // no work: it acts along gravity
      for (Index c = begin; c < end; ++c)
        a[c] -= scale * per_distance[c] * (p[c] - p[c - s]) / std::max(face_mean(phi, c, s), stress_fraction_floor);
      return;
    }
    if (per_distance) scale *= per_distance[begin];
#pragma GCC ivdep
    for (Index c = begin; c < end; ++c)
      a[c] -= scale * (p[c] - p[c - s]) / std::max(face_mean(phi, c, s), stress_fraction_floor);
    if (work.empty()) return;
    const double* jump = work.data();
#pragma GCC ivdep
    for (Index c = begin; c < end; ++c) a[c] -= scale * jump[c] / std::max(face_mean(phi, c, s), stress_fraction_floor);
  });
}

void add_species_exchange_loops(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields) {
  const std::size_t n = constants.species();
  for_each_solids_row(constants, boundaries, [&](std::size_t j, int axis, Index begin, Index end) {
    const auto d = std::size_t(axis);
    const Index s = constants.grid.stride(axis);
    const double* v = fields.solids.velocity[j][d].data();
    double* a = fields.solids.acceleration[j][d].data();
    const double per_density = 1 / constants.density[j];
    for (std::size_t k = 0; k < n; ++k) {
      if (k == j) continue;
      const double *coefficient = fields.species_exchange[pair_index(std::min(j, k), std::max(j, k), n)].data(),
                   *phi = fields.solids.fraction[k].data(), *w = fields.solids.velocity[k][d].data();
#pragma GCC ivdep
      for (Index c = begin; c < end; ++c)
        a[c] += face_mean(coefficient, c, s) * face_mean(phi, c, s) * per_density * (w[c] - v[c]);
    }
  });
}

}  // namespace

void continuity(const Constants& constants, const fluid::Boundaries& boundaries, Scheme scheme, double t,
                Fields& fields, const FaceList* first_order) {
  const core::Grid& grid = constants.grid;
  const bool compressible = fields.fluid.compression.present();
  if (compressible) fields.fluid.compression.flux = fields.fluid.flux;
  for (std::size_t j = 0; j < constants.species(); ++j) {
    const Field& phi = fields.solids.fraction[j];
    const core::FaceField& velocity = fields.solids.velocity[j];
    core::FaceField& flux = fields.solids_flux[j];
    if (scheme == Scheme::limited)
      core::in_vectors<solids_flux<LimitedFractionFace>>(grid, boundaries, phi, velocity, flux);
    else
      core::in_vectors<solids_flux<core::UpwindFace>>(grid, boundaries, phi, velocity, flux);
    if (first_order != nullptr) redo_upwind(grid, *first_order, phi, velocity, flux);
    if (constants.openings.present()) constants.openings.cross(t, j, fields.solids, flux);
    if (compressible) subtract(flux, fields.fluid.compression.flux);
    Field& rate = fields.solids.fraction_rate[j];
    core::divergence(grid, flux, rate);
    for (double& r : rate) r = -r;
  }
  boundaries.fill_cells(fields.solids.fraction_rate);
  for (std::size_t j = 0; j < constants.species() && constants.openings.present(); ++j)
    constants.openings.set_rate_ghosts(t, j, fields.solids);
}

void fluid_flux_through_ends(const Constants& constants, const fluid::Boundaries& boundaries, double t,
                             Fields& fields) {
  const auto on_ends = [&](auto&& body) {
    const auto see = [&](core::ColumnFace at) {
      fluid::for_each_boundary_row(constants.grid, axis_of(at), side_of(at), [&](Index begin, Index end) {
        for (auto c = std::size_t(begin); c < std::size_t(end); ++c) body(std::size_t(axis_of(at)), c);
      });
    };
    see(core::ColumnFace::bottom);
    see(core::ColumnFace::top);
    for (const core::ColumnFace at : boundaries.crossed()) see(at);
  };
  core::FaceField& own = fields.fluid.compression.flux;
  on_ends([&](std::size_t a, std::size_t c) { own[a][c] = fields.fluid.flux[a][c]; });
  for (std::size_t j = 0; j < constants.species() && constants.openings.present(); ++j) {
    core::FaceField& flux = fields.solids_flux[j];
    constants.openings.cross(t, j, fields.solids, flux);
    on_ends([&](std::size_t a, std::size_t c) { own[a][c] -= flux[a][c]; });
  }
}

void add_gravity(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields) {
  for (std::size_t j = 0; j < constants.species(); ++j) {
    const double weight = (1 - constants.fluid.density / constants.density[j]) * constants.gravity;
    for (int axis = 0; axis < constants.grid.dimensions; ++axis) {
      const auto d = std::size_t(axis);
      if (constants.down[d] == 0) continue;
      const double along = weight * constants.down[d];
      double* a = fields.solids.acceleration[j][d].data();
      core::for_each_row(constants.grid, boundaries.moving_faces(axis, false), [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c) a[c] += along;
      });
    }
  }
}

void add_exchange(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields) {
  fluid::with_form(fields.solids, [&]<class Form>(Form) {
    core::in_vectors<add_exchange_loops<Form>>(constants, boundaries, fields);
  });
}

void subtract_stress(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields) {
  core::in_vectors<subtract_stress_loops>(constants, boundaries, fields);
}

void add_species_exchange(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields) {
  core::in_vectors<add_species_exchange_loops>(constants, boundaries, fields);
}

}  // namespace polybed::tfm
