// Momentum of the averaged fluid and the rate of the volumetric flux, T(1.16) with T(1.17), on faces.
//
//   (3) a_f = -(U_f.grad)U_f - sum_j phi_j b_j (U_f - U_j) / (eps rho_f)
//       (gravity is in the net pressure; for a compressible fluid see compressible.hpp)
//   (4) dJ/dt = eps a_f + sum_j phi_j a_j + sum_j (U_j - U_f) dphi_j/dt - B grad p,
//       B = eps/rho_f + sum_j phi_j/rho_j
//
// In form B the gradient of the pressure is in the fluid's momentum alone: B = 1/rho_f.
//
// J = eps U_f + sum phi_j U_j is the unknown, because its constraint div J = 0 is linear with constant coefficients.
#pragma once

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "fluid/boundaries.hpp"
#include "fluid/fluid_state.hpp"
#include "fluid/interphase.hpp"

namespace polybed::fluid {

/// Equation (4) before the pressure acts.
struct FluxRate {
  core::FaceField free;      ///< dJ/dt without -B grad p, m/s2; 0 on held faces
  core::FaceField mobility;  ///< B, m3/kg; 0 on held faces

  FluxRate() = default;
  explicit FluxRate(const core::Grid& grid)
      : free(core::make_face_field(grid)), mobility(core::make_face_field(grid)) {}
};

/// Voidage on the face c between c - s and c for upwind drag; the upstream cell is the one from which the fluid comes
/// relative to the particles. Inside a bed it is the mean of both cells. At the end of a bed it is nearly the upstream
/// cell's own: where the voidage rises to the next cell by more than twice the rise behind it and a twentieth of the
/// upstream solids (both chosen). Without the twentieth every ripple of a uniform bed would switch between the two, and
/// Newton's method would converge badly.
[[nodiscard]] inline double voidage_upstream(const double* eps, core::Index c, core::Index s, double slip) {
  const double here = eps[c] - eps[c - s], from = slip > 0 ? eps[c - s] : eps[c], rise = slip > 0 ? here : -here,
               before = slip > 0 ? eps[c - s] - eps[c - 2 * s] : eps[c] - eps[c + s],
               most = 2 * std::max(before, 0.0) + 0.05 * (1 - from);
  return std::max(from + 0.5 * std::min(rise, most), voidage_floor);
}

/// b_j on the face between the cells c - s and c: taken from the upstream cell relative to the particles, with half a
/// limited slope. A mean of both cells would not see a ripple from cell to cell, which nothing else resists below
/// packing. Drag grows with the solids fraction, so waves of voidage travel with the slip: this is upwinding. Particles
/// are suspended by b_j/eps^2, the force over the superficial slip eps (U_f - U_j), including the pressure gradient of
/// drag. At the end of a bed the face has a larger voidage than the bed; the bed's b_j/eps^2 is used there, so that the
/// topmost cell keeps the bed's solids fraction however full the cell above is.
/// \param b, eps  on cells, ghosts filled  \param slip  U_f - U_j on the face, m/s
[[nodiscard]] inline double exchange_on_face(const double* b, const double* eps, core::Index c, core::Index s,
                                             double slip) {
  const double ratio = std::max(core::face_mean(eps, c, s), voidage_floor) / voidage_upstream(eps, c, s, slip);
  return core::LimitedFace::at(b, c, s, slip) * ratio * ratio;
}

/// The same for form B, whose b_j is divided by the voidage and includes the pressure gradient of drag.
[[nodiscard]] inline double net_exchange_on_face(const double* b, const double* eps, core::Index c, core::Index s,
                                                 double slip) {
  return core::LimitedFace::at(b, c, s, slip) * std::max(core::face_mean(eps, c, s), voidage_floor) /
         voidage_upstream(eps, c, s, slip);
}

/// Interpolation of b_j from cells to a face, for loops that are compiled for each form.
struct FormA {
  static double at(const double* b, const double* eps, core::Index c, core::Index s, double slip) {
    return exchange_on_face(b, eps, c, s, slip);
  }
};
struct FormB {
  static double at(const double* b, const double* eps, core::Index c, core::Index s, double slip) {
    return net_exchange_on_face(b, eps, c, s, slip);
  }
};

/// Calls act(FormA) or act(FormB).
template <class Act>
void with_form(const Interphase& solids, Act&& act) {
  solids.carry_pressure ? act(FormA()) : act(FormB());
}

/// Voidage from the solids fractions; the ghosts of the fractions must be filled.
void voidage(const Interphase& solids, core::Field& out);

/// U_f = (J - sum phi_j U_j) / max(eps, voidage_floor) on all owned faces.
void fluid_velocity(const core::Grid& grid, const Interphase& solids, FluidState& fluid);

/// Subtracts the drag of the solids from the fluid's acceleration a_f: the second term of (3).
/// \param density  rho_f, kg/m3; here and below a compressible fluid uses its own field instead
void subtract_exchange(const core::Grid& grid, const Boundaries& boundaries, const Interphase& solids,
                       const FluidState& fluid, double density, core::FaceField& acceleration);

/// Equation (4) without the pressure. acceleration is a_f; reads solids.acceleration and fraction_rate (with ghosts).
/// On the outlet's faces the solids are held, so only the fluid moves there.
void flux_rate(const core::Grid& grid, const Boundaries& boundaries, const Interphase& solids, const FluidState& fluid,
               double density, const core::FaceField& acceleration, FluxRate& out);

}  // namespace polybed::fluid
