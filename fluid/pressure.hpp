// The net pressure that keeps the volumetric flux free of divergence, rows (4) and (5):
//
//   -div(B grad p) = -(div free + w div J),      dJ/dt = free - B grad p,    dU_j/dt = a_j - grad p / rho_j
//
// w > 0 (Baumgarte) drives the remaining div J, from inexact solves, back to zero.
#pragma once

#include "core/numerics/linear_solver.hpp"
#include "fluid/momentum.hpp"

namespace polybed::fluid {

class Pressure {
 public:
  /// tolerance: relative residual of the Poisson equation.
  Pressure(const core::Grid& grid, double tolerance);

  /// Solves for p, starting from the given p; returns the solver's result. Nothing else changes.
  /// \param rate  dJ/dt without pressure and the mobility B
  /// \param flux  J, m/s
  /// \param w     rate at which div J is driven to zero, 1/s
  core::PoissonResult solve(const FluxRate& rate, const core::FaceField& flux, double w, core::Field& pressure);
  /// Starts anew: further solves do not depend on earlier ones.
  void forget() { solver_.forget(); }

 private:
  core::Grid grid_;
  double tolerance_;
  core::PoissonSolver solver_;
  core::Field divergence_, source_;
  core::FaceField open_mobility_;  ///< for a round column
};

/// Calls body(begin, end, gradient) for rows of an axis's moving faces, where gradient(c) is dp/dx_axis,
/// Pa/m, at face c. p must be 0 in the ghosts at the outlet (set_outlet_pressure).
template <class Body>
void for_each_gradient_row(const core::Grid& grid, const core::Box& box, int axis, const core::Field& p, Body&& body) {
  const core::Index s = grid.stride(axis);
  const double per_length = 1 / grid.spacing[std::size_t(axis)];
  const double* value = p.data();
  const double* graded = grid.graded(axis) ? grid.metric->per_distance[std::size_t(axis)].data() : nullptr;
  core::for_each_row(grid, box, [&](core::Index begin, core::Index end) {
    if (graded)
      body(begin, end, [=](core::Index c) { return per_length * graded[c] * (value[c] - value[c - s]); });
    else
      body(begin, end, [=](core::Index c) { return per_length * (value[c] - value[c - s]); });
  });
}

/// Sets p = 0 half a cell beyond the outlet and the open faces of the sides, and the ghosts owned by other cells.
/// Collective.
void set_outlet_pressure(const core::Grid& grid, const Boundaries& boundaries, core::Field& pressure);

/// Largest |div J| h / U over the block's cells: the error in conservation of volume. U: a velocity scale, m/s.
[[nodiscard]] double divergence_error(const core::Grid& grid, const core::FaceField& flux, double velocity_scale);

}  // namespace polybed::fluid
