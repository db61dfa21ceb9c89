// Discharge rate of dry particles through an opening in a flat bottom, from a correlation.
#pragma once

#include <cmath>

namespace polybed::closures {

/// Least opening, in particle diameters, in the data of hopper_discharge(); narrower ones can block.
inline constexpr double least_hopper_opening = 5;

/// Mass flow through a round hole or a slot in a flat bottom, kg/s; 0 up to a width of 1.4 d. Hole: W = 0.583 rho_b
/// sqrt(g) (D - 1.4 d)^2.5 (Beverloo, Leniger and van de Velde, Chem. Eng. Sci. 15 (1961) 260). Slot: W = 1.03 rho_b
/// sqrt(g) L (B - 1.4 d)^1.5 (Nedderman et al., Chem. Eng. Sci. 37 (1982) 1597), the same velocity over the square root
/// of the hydraulic diameter. For spheres, openings above five diameters and beds higher than the opening is wide; the
/// constants depend on friction, by 20 % in this project's runs (docs/record/verification-particles.md).
/// \param width         D of a hole or B of a slot, m
/// \param length        L of a slot, m, limited to the part that particles pass; 0: a hole
/// \param diameter      d, m
/// \param bulk_density  rho_b, of the bed, kg/m3
/// \param gravity       g, m/s2
[[nodiscard]] inline double hopper_discharge(double width, double length, double diameter, double bulk_density,
                                             double gravity) {
  const double free = width - 1.4 * diameter;  // width between the empty rims
  if (!(free > 0)) return 0;
  const double flux = bulk_density * std::sqrt(gravity * free);
  return length > 0 ? 1.03 * flux * length * free : 0.583 * flux * free * free;
}

}  // namespace polybed::closures
