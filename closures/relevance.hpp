// Measures of how much each effect matters in a scene: one pure function of plain numbers for each deciding number. A
// force uses the closure of a run, as a share of a reference force, the buoyant weight of the particle.
//
// Scales (docs/reference/effects.md): slip w = U/eps, width L, shear rate, time of the scene, relaxation time of the
// slip.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "closures/added_mass.hpp"
#include "closures/cohesion_van_der_waals.hpp"
#include "closures/gas_slip.hpp"
#include "closures/history_basset.hpp"
#include "closures/kinetic_theory.hpp"
#include "closures/lift_saffman_mei.hpp"
#include "closures/liquid_bridge_willett.hpp"
#include "closures/lubrication.hpp"
#include "closures/magnus_rubinow_keller.hpp"
#include "closures/species_exchange_syamlal.hpp"
#include "closures/sphere.hpp"

namespace polybed::closures {

/// Least gap of surfaces in contact in the estimate of attraction, m.
inline constexpr double relevance_contact_gap = 0.4e-9;

/// W = V |rho_p - rho_f| g, N.
[[nodiscard]] inline double buoyant_weight(double diameter, double density, double fluid_density, double gravity) {
  return sphere_volume(0.5 * diameter) * std::abs(density - fluid_density) * gravity;
}

/// Pure drag over the slip U_f - U_p, kg/s: 3 pi mu d eps f. \param f  over Stokes, for the superficial slip
[[nodiscard]] inline double drag_per_slip(double diameter, double viscosity, double voidage, double f) {
  return 3 * std::numbers::pi * viscosity * diameter * voidage * f;
}

/// tau_p = m/(drag per slip) = rho_p d^2/(18 mu eps f), s: f includes the effect of neighbours.
[[nodiscard]] inline double slip_relaxation_time(double diameter, double density, double viscosity, double voidage,
                                                 double f) {
  return density * diameter * diameter / (18 * viscosity * voidage * f);
}

/// Shear between particles, 1/s: the slip over ten diameters.
[[nodiscard]] inline double shear_rate_inside(double slip, double diameter) { return slip / (10 * diameter); }

/// Shear next to a wall, 1/s: max(10 w/L, w/(10 d)); the slip drops over a tenth of the width.
[[nodiscard]] inline double shear_rate_at_wall(double slip, double width, double diameter) {
  return std::max(10 * slip / width, shear_rate_inside(slip, diameter));
}

/// Acceleration of a packed clump in clear fluid, m/s2: g' = phi abs(rho_p - rho_f) g/rho_mix, with the mean density
/// rho_mix = phi rho_p + (1 - phi) rho_f. The same for light particles, which rise.
[[nodiscard]] inline double clump_acceleration(double phi, double density, double fluid_density, double gravity) {
  return phi * std::abs(density - fluid_density) * gravity / (phi * density + (1 - phi) * fluid_density);
}

/// Greatest shear on a run's grid, 1/s: over a cell the fluid changes from rest (a wall, a closed packing) to the slip,
/// and a clump of a cell's size gains the speed of its fall over its own height: w/h + sqrt(2 g'/h). An energy scale
/// for a fall, without slip; excludes larger convection along a wall.
[[nodiscard]] inline double shear_rate_of_cell(double slip, double acceleration, double spacing) {
  return slip / spacing + std::sqrt(2 * acceleration / spacing);
}

/// Spin of a sphere that sticks at first contact with speed v along the surface of a far heavier body, 1/s: 5/7 of v/R
/// from the balance of angular momentum about the point of contact, 10 v/(7 d). Sliding friction gives less.
[[nodiscard]] inline double spin_of_impact(double speed, double diameter) { return 10 * speed / (7 * diameter); }

/// Time over which a particle's surroundings change, s: max(L/w, tau_p). slip > 0.
[[nodiscard]] inline double time_of_scene(double width, double slip, double relaxation_time) {
  return std::max(width / slip, relaxation_time);
}

/// C_m s/(1 + C_m s), s = rho_f/rho_p: error of the velocity at tau_p without added mass.
[[nodiscard]] inline double added_mass_relevance(double coefficient, double density_ratio) {
  return coefficient * density_ratio / (1 + coefficient * density_ratio);
}

/// 1.5 d^2 sqrt(pi rho_f mu) 2 w/sqrt(t)/F_ref: the slip reverses within t. Creeping flow: an upper limit above Re_p 1.
[[nodiscard]] inline double history_relevance(double diameter, double fluid_density, double viscosity, double slip,
                                              double time, double reference) {
  return basset_prefactor(diameter, fluid_density, viscosity) * 2 * slip / std::sqrt(time) / reference;
}

/// Its lower limit: the same with the kernel of Mei and Adrian, which forgets vorticity that the wake has removed.
[[nodiscard]] inline double history_relevance_least(double diameter, double fluid_density, double viscosity,
                                                    double slip, double time, double reference) {
  const double nu = viscosity / fluid_density;
  return history_relevance(diameter, fluid_density, viscosity, slip, time, reference) *
         history_kernel_mei_adrian(time, diameter, nu, slip) / history_kernel_basset(time, diameter, nu);
}

/// |Saffman's lift with the share of Mei|/F_ref, with the vorticity normal to the slip.
[[nodiscard]] inline double lift_relevance(double diameter, double fluid_density, double viscosity, double slip,
                                           double vorticity, double reference) {
  const Vec3 force = lift_saffman_mei({slip, 0, 0}, {0, 0, vorticity}, diameter, fluid_density, viscosity);
  return std::sqrt(dot(force, force)) / reference;
}

/// |Force of Rubinow and Keller|/F_ref for a sphere whose spin differs from the fluid's by `spin`, 1/s.
[[nodiscard]] inline double magnus_relevance(double diameter, double fluid_density, double viscosity, double slip,
                                             double spin, double reference) {
  const Vec3 force = magnus_rubinow_keller({slip, 0, 0}, {0, 0, spin}, diameter, fluid_density, viscosity);
  return std::sqrt(dot(force, force)) / reference;
}

/// 1/Pe = 2 D_B/(u_t d).
[[nodiscard]] inline double brownian_relevance(double temperature, double viscosity, double diameter,
                                               double terminal_velocity) {
  return 2 * brownian_diffusivity(temperature, viscosity, diameter) / (terminal_velocity * diameter);
}

/// 1.257 Kn, Kn = 2 lambda/d: reduction of the drag through gas slip, for small Kn.
[[nodiscard]] inline double gas_slip_relevance(double free_path, double diameter) {
  return 1.257 * 2 * free_path / diameter;
}

/// 2 sqrt(mu/beta)/L: share of the width in which the fluid's stress instead of drag carries the shear. \param beta
/// for all solids on U_f - U_p, kg/(m3 s)
[[nodiscard]] inline double fluid_stress_relevance(double viscosity, double beta, double width) {
  return 2 * std::sqrt(viscosity / beta) / width;
}

/// Contact of species k on species j over the drag on j: K_jk phi_k |U_j - U_k|/(beta_j w/phi_j).
/// \param exchange K_jk/(phi_j phi_k), kg/(m3 s)  \param speed |U_j - U_k|, m/s  \param beta_per_fraction beta_j/phi_j
[[nodiscard]] inline double species_exchange_relevance(double exchange, double fraction_k, double speed,
                                                       double beta_per_fraction, double slip) {
  return exchange * fraction_k * speed / (beta_per_fraction * slip);
}

/// Greatest attraction of two rough surfaces over F_ref: A R*/(6 z0^2), R* half an asperity's radius, z0 0.4 nm.
[[nodiscard]] inline double van_der_waals_relevance(double hamaker, double roughness, double reference) {
  return van_der_waals_pull_off(hamaker, 0.5 * roughness, relevance_contact_gap) / reference;
}

/// Bond number: greatest attraction by a liquid bridge between two equal spheres over F_ref.
/// \param surface_tension  gamma, N/m  \param contact_angle  theta, rad
[[nodiscard]] inline double capillary_relevance(double surface_tension, double contact_angle, double diameter,
                                                double reference) {
  return liquid_bridge_pull(0.5 * diameter, surface_tension, contact_angle) / reference;
}

/// Distance over which fluctuations are conducted before collisions dissipate them, m: D sqrt(k/(1.5 Gamma)) from the
/// linearised balance, Garzo and Dufty's dissipation. e < 1. The fluid's drag shortens it.
[[nodiscard]] inline double conduction_length(double diameter, double phi, double restitution) {
  const double g0 = radial_distribution_dense(phi).value;
  return diameter * std::sqrt(kinetic_conductivity(phi, g0, restitution) /
                              (1.5 * kinetic_dissipation(KineticModel::garzo_dufty, phi, g0, restitution)));
}

}  // namespace polybed::closures
