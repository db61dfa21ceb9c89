// The discrete operators of the staggered grid, and the slope limiter.
#pragma once

#include <type_traits>

#include "core/numerics/metric.hpp"

namespace polybed::core {

/// Calls body(axis) for the axes of a grid, each a compile-time constant: the compiler then removes the loop over axes
/// from a loop over cells and vectorises the latter. A body with loops in a kernel of core::in_vectors must be
/// always_inline; otherwise g++ compiles it separately, at the least width.
template <std::size_t dimensions, class Body>
[[gnu::always_inline]] inline void for_each_axis(Body&& body) {
  body(std::integral_constant<std::size_t, 0>{});
  body(std::integral_constant<std::size_t, 1>{});
  if constexpr (dimensions == 3) body(std::integral_constant<std::size_t, 2>{});
}

/// Slope of van Albada (1982) from the differences a, b on either side; 0 at an extremum. The usual small number in the
/// denominator is left out, so that the slope scales with its arguments: a species can be split in two. A product above
/// 0 implies a denominator above 0.
[[nodiscard]] inline double limited_slope(double a, double b) {
  const double product = a * b;
  return product > 0 ? product * (a + b) / (a * a + b * b) : 0.0;
}

/// Difference over one cell of the quantity q at entry c, upwind for a velocity of sign `u`: first order.
struct UpwindDifference {
  static double at(const double* q, Index c, Index s, double u) { return u > 0 ? q[c] - q[c - s] : q[c + s] - q[c]; }
};

/// Value of q at the face between c - s and c, upwind for the velocity u: first order.
struct UpwindFace {
  static double at(const double* q, Index c, Index s, double u) { return u > 0 ? q[c - s] : q[c]; }
};

/// The same plus half a limited slope (TVD): second order where q is smooth, bounded everywhere.
struct LimitedFace {
  static double at(const double* q, Index c, Index s, double u) {
    const double below = q[c - s] - q[c - 2 * s], here = q[c] - q[c - s], above = q[c + s] - q[c];
    const double from = u > 0 ? q[c - s] : q[c], half = 0.5 * limited_slope(u > 0 ? below : above, here);
    return u > 0 ? from + half : from - half;
  }
};

/// Mean of a cell field on the face c of an axis with stride s.
[[nodiscard]] inline double face_mean(const double* q, Index c, Index s) { return 0.5 * (q[c - s] + q[c]); }

/// Divergence of a face field in all owned cells: out[c] = sum over axes (alpha f[c + s] - alpha f[c]) / (theta h).
void divergence(const Grid& grid, const FaceField& faces, Field& out);

/// Adds -(U.grad)U, first order, to the acceleration on the faces of one axis within a box. Ghosts of the velocity must
/// be filled.
inline void subtract_convection(const Grid& grid, const FaceField& velocity, int axis, const Box& box, Field& rate) {
  const double* u = velocity[std::size_t(axis)].data();
  double* to = rate.data();
  const Index s = grid.stride(axis);
  const double per_length = 1 / (axis == 1 ? grid.height(grid.before[1] + box.lo[1]) : grid.spacing[std::size_t(axis)]);
  for_each_row(grid, box, [&](Index begin, Index end) {
#pragma GCC ivdep
    for (Index c = begin; c < end; ++c) to[c] -= u[c] * per_length * UpwindDifference::at(u, c, s, u[c]);
  });
  for (int across = 0; across < grid.dimensions; ++across) {
    if (across == axis) continue;
    const double* v = velocity[std::size_t(across)].data();
    const Index t = grid.stride(across);
    const double per_width = 1 / grid.spacing[std::size_t(across)];
    if (grid.graded(across)) {
      const double* per_distance = grid.metric->per_distance[std::size_t(across)].data();
      for_each_row(grid, box, [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c) {
          const double transverse = 0.25 * ((v[c] + v[c - s]) + (v[c + t] + v[c - s + t]));
          to[c] -= transverse * per_width * per_distance[transverse > 0 ? c : c + t] *
                   UpwindDifference::at(u, c, t, transverse);
        }
      });
      continue;
    }
    for_each_row(grid, box, [&](Index begin, Index end) {
#pragma GCC ivdep
      for (Index c = begin; c < end; ++c) {
        const double transverse = 0.25 * ((v[c] + v[c - s]) + (v[c + t] + v[c - s + t]));
        to[c] -= transverse * per_width * UpwindDifference::at(u, c, t, transverse);
      }
    });
  }
}

/// Adds -[div(F U) - U div F] for the velocity U on the faces of one axis within a box; F, on the faces of all axes,
/// transports it. A cell of U consists of halves of two grid cells, and the F between two cells of U is the mean of
/// their fluxes. The sum over cells of U times the mean of dphi/dt = -div F, plus this term, then telescopes. Face:
/// UpwindFace or LimitedFace. Ghosts of U must be filled, and ghosts of F that other cells own.
template <class Face, class Metric>
void subtract_carried(const Metric& metric, const Grid& grid, const FaceField& flux, const Field& velocity, int axis,
                      const Box& box, Field& rate) {
  const double* u = velocity.data();
  double* to = rate.data();
  const Index s = grid.stride(axis);
  for (int along = 0; along < grid.dimensions; ++along) {
    const auto b = std::size_t(along);
    const double* f = flux[b].data();
    const Index t = grid.stride(along);
    const double per_length = 1 / grid.spacing[b];
    const auto through = [=](Index c) { return metric.open(b, c) * f[c]; };
    for_each_row(grid, box, [&](Index begin, Index end) {
#pragma GCC ivdep
      for (Index c = begin; c < end; ++c) {
        const double in = 0.5 * (through(c - s) + through(c)), out = 0.5 * (through(c + t - s) + through(c + t));
        to[c] -= metric.per_volume_on(std::size_t(axis), c) * per_length *
                 (out * (Face::at(u, c + t, t, out) - u[c]) - in * (Face::at(u, c, t, in) - u[c]));
      }
    });
  }
}

}  // namespace polybed::core
