// A bound on the solids' stress for real characteristics of the averaged equations of one solid and the fluid.
#pragma once

namespace polybed::closures {

/// G_crit = phi rho_s rho_f w^2 / (eps rho_s + phi rho_f), Pa: the least slope G = dp_s/dphi for which the
/// one-dimensional incompressible equations are well-posed (Stewart 1979; Stuhmiller 1977 for other closures).
/// From a (c - U_s)^2 + b (c - U_f)^2 = G/phi for the wave speed c, with a = rho_s/phi, b = rho_f/eps, whose roots are
/// real if and only if G/phi >= a b w^2/(a + b).
/// \param solids_fraction  phi, in (0, 1)  \param slip  w = U_f - U_s, m/s
[[nodiscard]] inline double critical_slope(double solids_fraction, double solids_density, double fluid_density,
                                           double slip) {
  return solids_fraction * solids_density * fluid_density * slip * slip /
         ((1 - solids_fraction) * solids_density + solids_fraction * fluid_density);
}

}  // namespace polybed::closures
