#include "multiscale/calibrate/reference.hpp"

#include <cmath>

#include "closures/kinetic_theory.hpp"
#include "closures/stress_reference.hpp"

namespace polybed::multiscale {

ReferenceStress kinetic_reference(const std::vector<BoxSpecies>& species, double restitution) {
  constexpr auto model = closures::KineticModel::garzo_dufty;
  double phi = 0, surface = 0;
  for (const BoxSpecies& s : species) {
    phi += s.phi;
    surface += s.phi / s.diameter;
  }
  ReferenceStress sum{0, 0, 0};
  for (const BoxSpecies& j : species) {
    double g0 = 0, collisions = 0;
    for (const BoxSpecies& k : species) {
      const double g = closures::radial_of_pair(1 - phi, surface, j.diameter, k.diameter);
      const double ratio = j.density * std::pow(j.diameter, 3) / (k.density * std::pow(k.diameter, 3));
      g0 += k.phi / phi * g;
      collisions += closures::mixture_pressure_of_pair(k.phi, g, restitution, j.diameter, k.diameter, ratio);
    }
    const double share = j.phi / phi, s = std::sqrt(j.theta);
    sum.pressure += j.phi * j.density * j.theta * (1 + collisions);
    sum.viscosity += share * closures::kinetic_viscosity(model, phi, g0, restitution) * j.density * j.diameter * s;
    sum.dissipation +=
        share * closures::kinetic_dissipation(model, phi, g0, restitution) * j.density * s * s * s / j.diameter;
  }
  return sum;
}

ReferenceStress viscous_reference(double phi, double friction, double viscosity, double shear_rate) {
  const double form = closures::viscous_stress_form(phi, closures::jamming_fraction(friction)).value;
  return {viscosity * shear_rate * form, viscosity * form, viscosity * form * shear_rate * shear_rate};
}

}  // namespace polybed::multiscale
