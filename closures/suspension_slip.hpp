// The slip of each species in an even suspension without ends, from the balance of its drag.
#pragma once

#include <span>
#include <vector>

#include "closures/drag.hpp"

namespace polybed::closures {

/// U_f - U_j of each species, m/s, positive if the fluid rises past it:
///
///   18 mu eps f_j/D_j^2 (U_f - U_j) = (rho_j - rho_f) g + G,
///
/// T(1.16) with T(1.49) for a steady, even state, f_j for the mixture at the superficial slips eps |U_f - U_j|. Any
/// finite arguments; G is the mean gradient of the net pressure along the height, -sum phi_j (rho_j - rho_f) g if it
/// carries all solids. Found by a damped fixed-point iteration, to 1e-12 where f_j grows at most linearly with the
/// slip.
/// \param share  x_j, [species]  \param diameter  D_j, m  \param excess  rho_j - rho_f, kg/m3
/// \param gravity  g, m/s2  \param gradient  G, Pa/m
[[nodiscard]] std::vector<double> suspension_slips(const DragLaw& law, double voidage, std::span<const double> share,
                                                   std::span<const double> diameter, std::span<const double> excess,
                                                   double fluid_density, double viscosity, double gravity,
                                                   double gradient);

}  // namespace polybed::closures
