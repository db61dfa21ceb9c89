// Convection of a velocity by itself, in conservative form: momentum that leaves one face arrives at the next.
//
//   -[div(F U) - U div F] / phi
//
// F is the phase's flux of volume, phi its fraction. A cell of the momentum consists of halves of two cells of the
// fractions. Between two of them F is the mean of the fluxes in both continuity equations (Harlow and Welch 1965): div
// F is then the mean of their -dphi/dt, and the sum of phi rho U over faces changes only by flow through the ends. A
// compressible fluid's density is taken as uniform within a cell of momentum.
#pragma once

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "fluid/boundaries.hpp"

namespace polybed::fluid {

/// A velocity that is extrapolated from open faces to faces closed by a sloping wall: flow along the wall keeps its
/// momentum, although the wall consists of steps. Collective.
/// \param steps  the closed faces: Metric::steps or Metric::steps_inside
[[nodiscard]] core::Field slipping(const core::Grid& grid, const Boundaries& boundaries, const core::Field& velocity,
                                   int axis, const std::array<std::vector<core::Index>, 3>& steps);

/// A velocity for viscous stresses: the steps of walls inside do not rub, their friction is a term of its own.
/// Collective.
[[nodiscard]] core::FaceField along_walls_inside(const core::Grid& grid, const Boundaries& boundaries,
                                                 const core::FaceField& velocity);

/// Sets the acceleration of a phase to its convection on its moving faces, m/s2, and to 0 elsewhere.
/// \param limited   second order with limited slopes; else first order, upwind
/// \param of_fluid  whether the outlet's faces move
/// \param flux      F, m/s, with ghosts owned by other cells
/// \param velocity  U, m/s, ghosts filled
/// \param fraction  (axis, face, stride of the axis) -> phi > 0 on the face
template <class Fraction>
void convection(const core::Grid& grid, const Boundaries& boundaries, bool limited, bool of_fluid,
                const core::FaceField& flux, const core::FaceField& velocity, Fraction&& fraction,
                core::FaceField& acceleration) {
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    const core::Index s = grid.stride(axis);
    core::Field& rate = acceleration[a];
    std::fill(rate.begin(), rate.end(), 0.0);
    core::Box inside = core::interior_faces(grid, axis);
    if (!of_fluid) inside = boundaries.with_solids(inside);
    const bool tapered = grid.metric && grid.metric->tapered();
    const core::Field along_wall =
        tapered ? slipping(grid, boundaries, velocity[a], axis, grid.metric->steps) : core::Field();
    const core::Field& carried = tapered ? along_wall : velocity[a];
    core::with_metric(
        grid, [&](const auto& metric) __attribute__((always_inline)) {
          if (limited)
            core::subtract_carried<core::LimitedFace>(metric, grid, flux, carried, axis, inside, rate);
          else
            core::subtract_carried<core::UpwindFace>(metric, grid, flux, carried, axis, inside, rate);
        });
    double* to = rate.data();
    core::for_each_row(grid, inside, [&](core::Index begin, core::Index end) {
#pragma GCC ivdep
      for (core::Index c = begin; c < end; ++c) to[c] /= fraction(a, c, s);
    });
    // Half the momentum cell of a face on the outlet would lie beyond it: that row keeps (U.grad)U.
    core::Box at_outlet = boundaries.moving_faces(axis, of_fluid);
    at_outlet.lo[a] = inside.hi[a];
    core::subtract_convection(grid, velocity, axis, at_outlet, rate);
  }
}

}  // namespace polybed::fluid
