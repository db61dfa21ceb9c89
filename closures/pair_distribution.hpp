// Where the neighbours of a hard sphere stand, in wave numbers: total correlation functions h_ij(r) = g_ij(r) - 1 of a
// mixture, by their Fourier transforms h_ij(k) = int h_ij(r) exp(-i k.r) d3r.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <span>

namespace polybed::closures {

/// Transform of spheres that keep each other out and are otherwise anywhere, m3: h = -1 within the contact, 0 beyond;
/// -4 pi (sin x - x cos x)/k^3, x = k contact: the limit of a dilute mixture.
/// \param k  wave number, 1/m, >= 0  \param contact  distance of the centres in contact, m
[[nodiscard]] double exclusion_spectrum(double k, double contact);

/// Random hard spheres in the Percus-Yevick approximation, by Baxter's factorisation of a mixture (J. Chem. Phys. 52,
/// 4559, 1970; Hiroike, J. Phys. Soc. Japan 27, 1415, 1969):
///   Q_ij(r) = a_i (r^2 - R_ij^2)/2 + b_i (r - R_ij),  (D_i - D_j)/2 < r < R_ij = (D_i + D_j)/2,
///   a_i = (1 - xi_3 + 3 D_i xi_2)/(1 - xi_3)^2,  b_i = -(3/2) D_i^2 xi_2/(1 - xi_3)^2,  xi_n = (pi/6) sum rho_j D_j^n,
///   q_ij(k) = delta_ij - 2 pi sqrt(rho_i rho_j) int exp(i k r) Q_ij dr,  (1 + sqrt(rho_i rho_j) h_ij) = (q^T(-k)
///   q)^-1.
class PercusYevick {
 public:
  /// \param fraction  phi_j > 0, their sum below 1  \param diameter  m
  PercusYevick(std::span<const double> fraction, std::span<const double> diameter);
  /// [i][j] h_ij(k), m3. \param k  1/m, >= 0
  [[nodiscard]] Eigen::MatrixXd spectrum(double k) const;

 private:
  [[nodiscard]] std::complex<double> factor(double k, Eigen::Index i, Eigen::Index j) const;
  Eigen::VectorXd diameter_, number_, a_, b_;  ///< number_: rho_j, 1/m3
};

}  // namespace polybed::closures
