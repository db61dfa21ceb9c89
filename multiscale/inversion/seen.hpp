// What particles see of a uniform mixture: averages taken by a kernel at a particle count the particle itself and miss
// the neighbours that it keeps away (docs/theory/particle-fluid.md).
#pragma once

#include <array>
#include <vector>

#include "core/case/scene.hpp"
#include "multiscale/inversion/models.hpp"

namespace polybed::multiscale {

/// The kernel of T(2.4)-(2.10): linear weights along each axis that has more than one cell, uniform along the others;
/// smoothed by diffusion, where the case has it so. Walls and joined sides are taken to be far.
struct AveragingKernel {
  std::array<double, 3> cell{};    ///< m; the whole column along an axis of one cell
  std::array<bool, 3> wide{};      ///< axes of one cell
  double time = 0;                 ///< tau of the diffusion, m2: a factor exp(-tau k^2); 0: none
  [[nodiscard]] int axes() const;  ///< along which it varies
};

/// The kernel of the particles of a case (dem.kernel).
[[nodiscard]] AveragingKernel averaging_kernel(const core::Scene& scene);

/// K(x, x) in the mean over x, 1/m3: what a volume of 1 adds to the average at its own place. Along an axis the mean of
/// w(x) w(x') is the cubic B-spline, (1/(2 pi)) int sinc^4(k a/2) dk = 2/(3 a).
[[nodiscard]] double kernel_at_itself(const AveragingKernel& kernel);

/// Transform of the kernel in the mean over the directions of k in its axes: of prod sinc^4(k_a a/2) exp(-tau k^2).
/// \param k  wave number, 1/m, >= 0  \return 1 at k = 0
[[nodiscard]] double kernel_spectrum(const AveragingKernel& kernel, double k);

/// How neighbours stand around a particle.
enum class Neighbours {
  kept_out,      ///< nowhere within contact, anywhere beyond: the dilute limit
  percus_yevick  ///< as hard spheres in equilibrium
};

/// The averages at a particle of either species.
class SeenAverages {
 public:
  /// \param diameter  m
  SeenAverages(const AveragingKernel& kernel, const std::array<double, 2>& diameter, Neighbours neighbours);

  /// [i][j]: fraction of species j seen by one of species i, phi_j [1 + int h_ij K dV] + delta_ij V_i K(x, x), no less
  /// than 0. \param phi  mean fractions, above 0
  [[nodiscard]] std::array<std::array<double, 2>, 2> fractions(const std::array<double, 2>& phi) const;

 private:
  [[nodiscard]] std::array<std::array<double, 2>, 2> excess(const std::array<double, 2>& phi) const;
  std::array<double, 2> diameter_;
  Neighbours neighbours_;
  double at_itself_;
  std::vector<double> k_, weight_;  ///< sum weight_ h(k_) is int h K dV
};

/// force_balance of inversion_points with the drag that each species has in what it sees, the fluid between the
/// particles moving at one velocity: the slip in the law of species i is u eps_i/eps; gravity and pressure are those of
/// the mean. Roots with 0.2 < voidage < 1, by rising voidage.
[[nodiscard]] std::vector<InversionPoint> seen_inversion_points(const BinaryBed& bed, const closures::DragLaw& law,
                                                                const SeenAverages& seen);

}  // namespace polybed::multiscale
