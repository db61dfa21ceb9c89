// The three forces on a particle and what connects them: T(1.17), (1.24), (1.31), (1.46)-(1.50).
#pragma once

namespace polybed::closures {

/// Net force over Stokes of species j: n_j = f_j + (1-eps) y_j^2 f_mean / eps, T(3.13)-(3.17); of one size n
/// = f/eps, T(1.50).
[[nodiscard]] inline double net_of_pure(double voidage, double f_pure, double poly_index, double f_mean) {
  return f_pure + (1 - voidage) * poly_index * poly_index * f_mean / voidage;
}

/// Exchange coefficient on U_f - U_j, kg/(m3 s): beta_j = 18 mu eps phi_j f_j / D_j^2, T(1.49).
/// \param viscosity mu, Pa s  \param diameter D_j, m
[[nodiscard]] inline double exchange_coefficient(double viscosity, double voidage, double solids_fraction,
                                                 double f_pure, double diameter) {
  return 18 * viscosity * voidage * solids_fraction * f_pure / (diameter * diameter);
}

}  // namespace polybed::closures
