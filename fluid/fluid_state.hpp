// The averaged fluid: its fields and its constants.
#pragma once

#include "core/field.hpp"

namespace polybed::fluid {

/// Density and viscosity of an incompressible fluid.
struct FluidConstants {
  double density = 0;    ///< rho_f, kg/m3
  double viscosity = 0;  ///< mu, Pa s
};

/// Least voidage that a velocity is divided by; below it the fluid's velocity is understated, not singular.
constexpr double voidage_floor = 0.05;

struct FluidState {
  core::FaceField flux;      ///< J = eps U_f + sum phi_j U_j: volumetric flux of the mixture, m/s, unknown
  core::FaceField velocity;  ///< U_f, m/s, follows from J
  core::Field voidage;       ///< eps = 1 - sum phi_j, cells
  core::Field pressure;      ///< net p: without the weight of the fluid, T(1.23), Pa, cells

  FluidState() = default;
  explicit FluidState(const core::Grid& grid)
      : flux(core::make_face_field(grid)),
        velocity(core::make_face_field(grid)),
        voidage(core::make_field(grid, 1)),
        pressure(core::make_field(grid)) {}
};

}  // namespace polybed::fluid
