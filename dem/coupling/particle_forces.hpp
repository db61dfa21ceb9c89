// Forces of the averaged fluid on each particle, with the local polydisperse composition, T(2.4)-(2.10).
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "closures/drag.hpp"
#include "core/case/scene.hpp"
#include "dem/coupling/fluid_motion.hpp"
#include "dem/coupling/gather.hpp"
#include "dem/coupling/own_share.hpp"
#include "dem/effects/maker.hpp"

namespace polybed::dem {

/// Number of evaluations of a law, and of those outside its range.
struct LawUse {
  std::uint64_t evaluations = 0, guarded = 0;
  std::uint64_t clamped_voidage = 0;  ///< voidages outside the range of a bed, clamped for closures
};

/// Widths over which averages spread a particle's drag over the fluid and return it.
struct OwnWake {
  double smoothed = 0;  ///< variance along an axis of the diffusion kernel, applied twice, m2
  double cell = 0;      ///< root mean square of the spacings, m

  /// Standard deviation along an axis of the Gaussian that approximates scatter and gather of a force together, m. For
  /// the weights alone: sqrt(2/pi) a/q with a the cell and q = 3.11 - 3.72 t - 1.60 n + 2.24 t n, where n is 2 f (1 -
  /// f) for the shares f, 1 - f along the force and t the mean over those across it. Fitted within 5 % to creeping
  /// spheres at 12 places in cells of 3 to 6 diameters (docs/theory/particle-fluid.md).
  /// \param along  squares of the components of the force, in any unit
  [[nodiscard]] double spread(const Lines& lines, const std::array<double, 3>& along) const {
    const auto shares = [](const Line& line) { return 2 * line.w[0] * line.w[1]; };
    const std::array<double, 3> cells{shares(lines.cell[0]), shares(lines.cell[1]), shares(lines.cell[2])};
    const double any = along[0] + along[1] + along[2] > 0 ? 0 : 1;  // at rest: each direction alike
    double sum = 0, weights = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double n = shares(lines.face[k]), t = 0.5 * (cells[(k + 1) % 3] + cells[(k + 2) % 3]);
      sum += (along[k] + any) * (3.11 - 3.72 * t - 1.60 * n + 2.24 * t * n);
      weights += along[k] + any;
    }
    const double of_cell = cell * weights / sum;
    return std::sqrt(smoothed + 2 / std::numbers::pi * of_cell * of_cell);
  }
};

class ParticleForces {
 public:
  ParticleForces(const core::Scene& scene, const Materials& materials, double fluid_density, double viscosity);

  /// Loads on each owned particle at its place and velocity: all of a FluidLoad except the impulse.
  /// \param own  null: averages include the particle itself
  void find(const Particles& particles, const Gather& gather, std::vector<FluidLoad>& loads,
            const OwnShare* own = nullptr);

  /// From now on drag uses the velocity without the particle's own contribution, closures::own_wake: for particles so
  /// few that no neighbour sees the same.
  void see_past_own_wake(const OwnWake& wake) { wake_ = wake; }

  /// Whether drag needs sum phi_j/D_j^2 around a particle.
  [[nodiscard]] bool needs_squares() const { return needs_squares_; }
  [[nodiscard]] bool has_added_mass() const { return laws_.added_mass != nullptr; }
  [[nodiscard]] LawUse use() const;

 private:
  struct Batch {
    static constexpr std::size_t most = 256;  ///< particles
    using Row = std::array<double, most>;
    Row fraction, voidage, per_mean, average, per_square{}, share, size, slip, f, spread;
  };
  struct Asked {
    const Particles& particles;
    const Gather& gather;
    const OwnShare* own;
    const OwnWake* wake;
    const std::vector<double>& diameter;
    bool needs_squares;
  };
  template <bool round>
  static void see(const Asked& asked, std::size_t begin, std::size_t count, FluidLoad* loads, Batch& batch);
  static std::uint64_t average(std::size_t count, Batch& batch);
  void add_mass(std::size_t count, FluidLoad* loads) const;
  void drag(const Particles& particles, std::size_t begin, std::size_t count, std::vector<FluidLoad>& loads);
  void ask_drag(const Particles& particles, std::size_t begin, std::size_t count, std::vector<FluidLoad>& loads);
  void remove_own_wake(const Particles& particles, std::size_t begin, std::size_t count, std::vector<FluidLoad>& loads);

  LoadLaws laws_;
  std::vector<double> diameter_;  ///< of each species, m
  std::vector<double> creeping_;  ///< 3 pi mu D for each species, over the divisor from gas slip, kg/s
  double largest_, fluid_density_, viscosity_;
  bool needs_squares_ = false;
  closures::GuardCount count_;
  std::uint64_t clamped_ = 0;
  std::optional<OwnWake> wake_;
  Batch batch_;
};

}  // namespace polybed::dem
