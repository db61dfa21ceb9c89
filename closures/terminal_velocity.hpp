// Terminal velocity of a single sphere for any pure drag law.
#pragma once

#include <cmath>

#include "closures/drag_schiller_naumann.hpp"
#include "closures/shape_factor.hpp"

namespace polybed::closures {

/// Terminal velocity, m/s >= 0, of one sphere in an unbounded fluid at rest: the root of
/// u f(1, rho_f u D / mu) = D^2 |rho_s - rho_f| g / (18 mu), T(1.49) at voidage 1.
/// \param f              callable (voidage, reynolds) -> pure drag over Stokes; u f must grow with u
/// \param diameter       D, m, > 0
/// \param excess         |rho_s - rho_f|, kg/m3
/// \param fluid_density  rho_f, kg/m3
/// \param viscosity      mu, Pa s, > 0
/// \param gravity        g, m/s2
template <class Drag>
[[nodiscard]] double terminal_velocity(Drag&& f, double diameter, double excess, double fluid_density, double viscosity,
                                       double gravity) {
  const double stokes = diameter * diameter * std::abs(excess) * gravity / (18 * viscosity);
  double low = 0, high = stokes;
  while (high > 0 && high * f(1.0, fluid_density * high * diameter / viscosity) < stokes) high *= 2;
  for (int n = 0; n < 200 && high - low > 1e-15 * high; ++n) {
    const double u = 0.5 * (low + high);
    (u * f(1.0, fluid_density * u * diameter / viscosity) < stokes ? low : high) = u;
  }
  return 0.5 * (low + high);
}

/// The same by the drag of Schiller and Naumann, good to 5 % up to a Reynolds number of 800. \param shape  factor on it
[[nodiscard]] inline double settling_velocity(double diameter, double excess, double fluid_density, double viscosity,
                                              double gravity, const ShapeFactor& shape = {}) {
  return terminal_velocity([&](double eps, double re) { return DragSchillerNaumann{}(eps, re).f * shape(eps, re); },
                           diameter, excess, fluid_density, viscosity, gravity);
}

}  // namespace polybed::closures
