// The closed forms that divide a box's stress; the two-fluid model multiplies by them again.
#pragma once

#include <vector>

namespace polybed::multiscale {

/// One species in a box.
struct BoxSpecies {
  double diameter, density, phi, theta;  ///< m, kg/m3, its own solids fraction, m2/s2
};

struct ReferenceStress {
  double pressure, viscosity, dissipation;  ///< Pa, Pa s, W/m3
};

/// Kinetic theory of a mixture at given temperatures, as in solids_stress = "kinetic": Enskog's pressure, and viscosity
/// and dissipation of Garzo and Dufty, species by species; g0 of Carnahan and Starling.
[[nodiscard]] ReferenceStress kinetic_reference(const std::vector<BoxSpecies>& species, double restitution);

/// Viscous form: p = mu_f gamma V(phi), mu_s = mu_f V(phi), closures/stress_reference.hpp. It has no separate
/// dissipation: mu_f V gamma^2.
[[nodiscard]] ReferenceStress viscous_reference(double phi, double friction, double viscosity, double shear_rate);

}  // namespace polybed::multiscale
