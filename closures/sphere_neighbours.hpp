// Excess of spheres around a sphere in a mixture over the number around any point: the effect of a particle's own
// presence on an average at its position.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <numbers>
#include <span>

namespace polybed::closures {

/// Random hard spheres in the Percus-Yevick approximation (Lebowitz, Phys. Rev. 133, A895, 1964), from its
/// compressibility, which equals scaled-particle theory's. With C_ij the integral of the direct correlation function
/// and rho_j the numbers per volume, Ornstein and Zernike's equation gives
///   T_ij = delta_ij + rho_j int h_ij dV = [(1 - C rho)^-1]_ij .
/// One species: T = (1 - phi)^4/(1 + 2 phi)^2, which is 1 alone, 0.21 at phi = 0.2 and 0.0156 at 0.5: in a dense bed
/// the neighbours that a sphere displaces compensate for its own volume.
///
/// -C_ij = (pi/6) sum_ab D_i^a A_ab D_j^b with a, b = 0..3, so that any number of species needs a system of four.
class SphereNeighbours {
 public:
  static constexpr double most_fraction = 0.74;  ///< A is constant above it: no bed is denser

  /// \param fraction  phi_j >= 0; their sum can be 0  \param diameter  m
  SphereNeighbours(std::span<const double> fraction, std::span<const double> diameter);

  /// T_ij: spheres of species j around one of i, itself included, in excess of rho_j V, in a volume V that is wide
  /// compared with the spheres. \param di, dj  diameters, m  \param phi_j  \param same  whether i is j
  [[nodiscard]] double excess(double di, double dj, double phi_j, bool same) const {
    const double number = phi_j / (std::numbers::pi / 6 * dj * dj * dj) * (unit_ * unit_ * unit_);
    return (same ? 1 : 0) - powers(di).dot(response_ * powers(dj)) * number;
  }

 private:
  using Vector4 = Eigen::Matrix<double, 4, 1>;
  using Matrix4 = Eigen::Matrix<double, 4, 4>;
  [[nodiscard]] Vector4 powers(double d) const {
    const double r = d / unit_;
    return {1, r, r * r, r * r * r};
  }
  double unit_;       ///< unit of length: the greatest diameter, m
  Matrix4 response_;  ///< A' (1 + M A')^-1, A' = (pi/6) A, M_ab the moments sum rho_j D_j^(a+b)
};

}  // namespace polybed::closures
