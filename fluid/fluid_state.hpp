// Fields of the averaged fluid.
#pragma once

#include "core/numerics/field.hpp"

namespace polybed::fluid {

/// Least voidage as a divisor of velocities; below it the fluid's velocity is underestimated but not singular.
constexpr double voidage_floor = 0.05;

/// Additional fields of a compressible fluid; all empty if it is incompressible.
struct Compression {
  core::Field density;        ///< rho_f of the total pressure, kg/m3, cells and ghosts
  core::Field kappa;          ///< eps/(rho_f c^2) of (5), 1/Pa, owned cells
  core::Field pressure_rate;  ///< dp/dt, Pa/s, owned cells
  core::FaceField flux;       ///< J - sum F_j: volume flux of the fluid alone, m/s
  [[nodiscard]] bool present() const { return !density.empty(); }
};

struct FluidState {
  core::FaceField flux;      ///< J = eps U_f + sum phi_j U_j: volumetric flux of the mixture, m/s, unknown
  core::FaceField velocity;  ///< U_f, m/s, follows from J
  core::Field voidage;       ///< eps = 1 - sum phi_j, cells
  core::Field pressure;      ///< net p: without the weight of the fluid, T(1.23), Pa, cells
  Compression compression;

  FluidState() = default;
  explicit FluidState(const core::Grid& grid)
      : flux(core::make_face_field(grid)),
        velocity(core::make_face_field(grid)),
        voidage(core::make_field(grid, 1)),
        pressure(core::make_field(grid)) {}
};

}  // namespace polybed::fluid
