// Pressure drop of a fixed bed from the pure drag on its particles.
#pragma once

#include "closures/bed_expansion.hpp"

namespace polybed::closures {

/// Drop of the net pressure per height, Pa/m: phi N/V with N = F_d/eps, so 18 mu u f(eps, Re) phi/(eps D^2), T(1.24);
/// at the balance of bed_expansion.hpp it is phi |rho_s - rho_f| g.
/// \param f  callable (voidage, reynolds) -> pure drag over Stokes  \param velocity  superficial, m/s, >= 0
template <class Drag>
[[nodiscard]] double pressure_gradient(Drag&& f, const CarriedBed& bed, double voidage, double velocity) {
  const double reynolds = bed.fluid_density * velocity * bed.diameter / bed.viscosity;
  return 18 * bed.viscosity * velocity * f(voidage, reynolds) * (1 - voidage) / (voidage * bed.diameter * bed.diameter);
}

}  // namespace polybed::closures
