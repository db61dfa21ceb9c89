// Times and step limits of particle contact. For set-up.
#pragma once

#include <cmath>
#include <numbers>

namespace polybed::closures {

/// dt_R = pi R sqrt(rho/G)/(0.1631 nu + 0.8766), s: a Rayleigh wave runs half around the sphere (Thornton and Randall,
/// in Micromechanics of Granular Materials, 1988, 133). \param shear_modulus G, Pa
[[nodiscard]] inline double rayleigh_time(double radius, double density, double shear_modulus, double poisson_ratio) {
  return std::numbers::pi * radius * std::sqrt(density / shear_modulus) / (0.1631 * poisson_ratio + 0.8766);
}

/// Greatest stable dt for the scheme in the thesis, U' = U + F dt/(2m), x += U' dt, F(x, U'), U = U' + F dt/(2m), with
/// one damped spring: 2 (sqrt(1 + zeta^2) - zeta)/omega, from w^2 + 4 zeta w = 4 with w = dt omega.
/// \param frequency omega = sqrt(S_n/m*), 1/s  \param damping_ratio zeta = c/(2 m* omega): beta in the linear law,
/// sqrt(5/6) beta in Hertz'
[[nodiscard]] inline double step_limit_thesis(double frequency, double damping_ratio) {
  return 2 * (std::sqrt(1 + damping_ratio * damping_ratio) - damping_ratio) / frequency;
}

/// The same with the force at the velocities after the full step, U'' = U' + F_old dt/(2m): 2 (sqrt(1 + 4 zeta^2) - 2
/// zeta)/omega.
[[nodiscard]] inline double step_limit_synchronised(double frequency, double damping_ratio) {
  return 2 * (std::sqrt(1 + 4 * damping_ratio * damping_ratio) - 2 * damping_ratio) / frequency;
}

/// 0.17 sqrt(m/k), s: dense linear contacts, least mass over greatest stiffness (O'Sullivan and Bray, Eng. Comput. 21,
/// 2004, 278).
[[nodiscard]] inline double dense_spring_step(double mass, double stiffness) {
  return 0.17 * std::sqrt(mass / stiffness);
}

}  // namespace polybed::closures
