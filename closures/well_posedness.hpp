// When the averaged equations of one solid and the fluid have real characteristics: a bound on the solids' stress.
#pragma once

#include <cmath>

namespace polybed::closures {

/// G_crit = phi rho_s rho_f w^2 / (eps rho_s + phi rho_f), Pa: the least slope G = dp_s/dphi for which the
/// one-dimensional incompressible equations are well-posed (Stewart 1979; Stuhmiller 1977 for other closures).
/// Follows from a (c - U_s)^2 + b (c - U_f)^2 = G/phi for the wave speed c, with a = rho_s/phi, b = rho_f/eps, whose
/// roots are real if and only if G/phi >= a b w^2/(a + b).
/// \param solids_fraction  phi, in (0, 1)  \param slip  w = U_f - U_s, m/s
[[nodiscard]] inline double critical_slope(double solids_fraction, double solids_density, double fluid_density,
                                           double slip) {
  return solids_fraction * solids_density * fluid_density * slip * slip /
         ((1 - solids_fraction) * solids_density + solids_fraction * fluid_density);
}

/// Growth rate, 1/s, of a wave of number k, 1/m, without drag: k Im(c); 0 where the equations are well-posed.
/// For G = 0: k |w| sqrt(a b)/(a + b), without bound as waves become short.
[[nodiscard]] inline double growth_without_drag(double wave_number, double solids_fraction, double solids_density,
                                                double fluid_density, double slip, double slope) {
  const double a = solids_density / solids_fraction, b = fluid_density / (1 - solids_fraction);
  const double missing = critical_slope(solids_fraction, solids_density, fluid_density, slip) - slope;
  return missing > 0 ? wave_number * std::sqrt(missing / solids_fraction / (a + b)) : 0.0;
}

}  // namespace polybed::closures
