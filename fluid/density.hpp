// Density of the fluid for kernels: one number, or a field for a compressible fluid. A kernel is compiled for both, so
// that the incompressible one has neither a field nor a branch.
#pragma once

#include "core/numerics/operators.hpp"
#include "fluid/fluid_state.hpp"

namespace polybed::fluid {

/// rho_f of an incompressible fluid.
struct EvenDensity {
  double value;  ///< kg/m3
  [[nodiscard]] double on_face(core::Index, core::Index) const { return value; }
};

/// rho_f of a compressible fluid, a function of the pressure.
struct LocalDensity {
  const double* cells;  ///< kg/m3, ghosts filled
  /// Mean of the cells c - s and c on the face between them.
  [[nodiscard]] double on_face(core::Index c, core::Index s) const { return core::face_mean(cells, c, s); }
};

/// Calls body(density) with the type of the fluid's density.
/// \param even  rho_f if the fluid is incompressible, kg/m3
template <class Body>
void with_density(const FluidState& fluid, double even, Body&& body) {
  if (fluid.compression.present())
    body(LocalDensity{fluid.compression.density.data()});
  else
    body(EvenDensity{even});
}

}  // namespace polybed::fluid
