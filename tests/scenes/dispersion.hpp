// Linear theory of small waves on an even fluidised bed of one species: how fast they grow and run.
//
// One dimension, flux of the mixture held at J, solids at rest, w = J/eps, F(phi, w) = b w/eps the drag after the
// pressure has been eliminated, G = dp_s/dphi, M = 4/3 mu_s. T(1.27) and T(1.28) of both phases for
// phi + phi' exp(ikx + st), with the solids' velocity from continuity and the fluid's from J:
//
//   (rho_s/phi + rho_f/eps) s^2 + [2 i k w rho_f/eps + k^2 M/phi^2 + F_w/(eps phi)] s
//     + k^2 (G/phi - w^2 rho_f/eps) + i k (F_phi + F_w w/eps) = 0
//
// Without drag its roots are those of closures/well_posedness.hpp.
#pragma once

#include <array>
#include <cmath>
#include <complex>

#include "closures/drag.hpp"
#include "core/case/scene.hpp"

namespace polybed::scenes {

/// F = 18 mu f w/D^2 of the first species by the scene's law, N/m3.
/// \param solids_fraction  in (0, 1)  \param slip  w, m/s, above 0
inline double drag_of_even_bed(const core::Scene& scene, double solids_fraction, double slip) {
  const double d = scene.species.at(0).diameter, mu = scene.fluid.viscosity.value(), eps = 1 - solids_fraction;
  const auto law = closures::drag_law(scene.effects.at("drag"), closures::Guard::on);
  const double reynolds = eps * slip * d * scene.fluid.density.value() / mu;
  return 18 * mu * closures::pure_drag_at(law, eps, reynolds) * slip / (d * d);
}

/// Superficial velocity at which the fluid carries the scene's even bed, F = (rho_s - rho_f) g, m/s; by bisection to
/// the last digits. Solids heavier than the fluid, carried below 10 m/s.
inline double carrying_velocity(const core::Scene& scene) {
  const double phi = scene.bed.start_solids_fraction;
  const double weight = (scene.species.at(0).density - scene.fluid.density.value()) * scene.column.gravity;
  double low = 0, high = 10;
  for (int n = 0; n < 100; ++n) {
    const double middle = 0.5 * (low + high);
    (drag_of_even_bed(scene, phi, middle / (1 - phi)) < weight ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// s, 1/s, of the two waves, first that which grows faster or decays more slowly: growth is the real part, -imag/k the
/// speed. The other is slip that relaxes.
/// \param velocity  J, m/s, above 0  \param k  2 pi over the length of the wave, 1/m  \param slope  G, Pa
/// \param resistance  M, Pa s
inline std::array<std::complex<double>, 2> rates_of_linear_theory(const core::Scene& scene, double velocity, double k,
                                                                  double slope, double resistance = 0) {
  const double phi = scene.bed.start_solids_fraction, eps = 1 - phi, w = velocity / eps;
  const double a = scene.species.at(0).density / phi, b = scene.fluid.density.value() / eps;
  constexpr double small = 1e-5;  // of central differences: their error is 1e-10 of F
  const double by_phi =
      (drag_of_even_bed(scene, phi * (1 + small), w) - drag_of_even_bed(scene, phi * (1 - small), w)) /
      (2 * small * phi);
  const double by_slip =
      (drag_of_even_bed(scene, phi, w * (1 + small)) - drag_of_even_bed(scene, phi, w * (1 - small))) / (2 * small * w);
  const std::complex<double> i(0, 1);
  const std::complex<double> linear = 2.0 * i * k * w * b + k * k * resistance / (phi * phi) + by_slip / (eps * phi);
  const std::complex<double> constant = k * k * (slope / phi - w * w * b) + i * k * (by_phi + by_slip * w / eps);
  const std::complex<double> root = std::sqrt(linear * linear - 4 * (a + b) * constant);
  const std::complex<double> one = (-linear + root) / (2 * (a + b)), other = (-linear - root) / (2 * (a + b));
  if (one.real() > other.real()) return {one, other};
  return {other, one};
}

}  // namespace polybed::scenes
