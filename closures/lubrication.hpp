// Fluid squeezed out between two spheres: as a lower restitution, or as the force of the film. Both add to the drag,
// which already contains the mean effect.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace polybed::closures {

/// St* = (rho_p + rho_f/2) d v/(9 mu) for a sphere that hits a wall (Legendre, Daniel and Guiraud, Phys. Fluids 17,
/// 2005, 097105). \param speed v > 0, approach
[[nodiscard]] inline double stokes_of_impact(double density, double fluid_density, double diameter, double speed,
                                             double viscosity) {
  return (density + 0.5 * fluid_density) * diameter * speed / (9 * viscosity);
}

/// St* = m* v/(6 pi mu R*^2) for a pair.
[[nodiscard]] inline double stokes_of_pair(double reduced_mass, double speed, double viscosity, double reduced_radius) {
  return reduced_mass * speed / (6 * std::numbers::pi * viscosity * reduced_radius * reduced_radius);
}

/// e exp(-35/St*) (Legendre et al. 2005). For set-up. St* <= 0 gives 0.
[[nodiscard]] inline double wet_restitution(double restitution, double stokes) {
  return stokes > 0 ? restitution * std::exp(-35 / stokes) : 0;
}

/// Film resistance 6 pi mu R*^2/h, kg/s: the force along n on i is -v_n times it, v_n negative on approach. Acts from
/// the range down to contact; h is at least the roughness, so that it stays finite.
/// \param reach range of the force, m, by default 0.1 R*  \param roughness m, > 0
[[nodiscard]] inline double film_resistance(double viscosity, double reduced_radius, double gap, double reach,
                                            double roughness) {
  const double h = gap > roughness ? gap : roughness;
  return gap < reach ? 6 * std::numbers::pi * viscosity * reduced_radius * reduced_radius / h : 0;
}

/// The part missing on a grid that resolves films above a gap: 6 pi mu R*^2 (1/h - 1/resolved) below it, kg/s (Nguyen
/// and Ladd, Phys. Rev. E 66 (2002) 046708). Otherwise as film_resistance().
/// \param resolved  m, > 0
[[nodiscard]] inline double unresolved_film_resistance(double viscosity, double reduced_radius, double gap,
                                                       double resolved, double roughness) {
  const double known = 6 * std::numbers::pi * viscosity * reduced_radius * reduced_radius / resolved;
  return std::max(film_resistance(viscosity, reduced_radius, gap, resolved, roughness) - known, 0.0);
}

}  // namespace polybed::closures
