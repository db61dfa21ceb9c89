// Forces of the averaged fluid on each particle, with the polydisperse composition that it sees, T(2.4)-(2.10).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "closures/drag.hpp"
#include "core/case/scene.hpp"
#include "dem/coupling/fluid_motion.hpp"
#include "dem/coupling/gather.hpp"
#include "dem/coupling/own_share.hpp"
#include "dem/coupling/own_wake.hpp"
#include "dem/effects/maker.hpp"

namespace polybed::dem {

/// How often a law was asked, and how often outside its range.
struct LawUse {
  std::uint64_t evaluations = 0, guarded = 0;
  std::uint64_t clamped_voidage = 0;  ///< voidages beyond what any bed has, held at the bounds for closures
};

class ParticleForces {
 public:
  ParticleForces(const core::Scene& scene, const Materials& materials, double fluid_density, double viscosity);

  /// What each owned particle feels at its place and velocity: all of a FluidLoad but the impulse.
  /// \param own  null: a particle is part of what it sees
  void find(const Particles& particles, const Gather& gather, std::vector<FluidLoad>& loads,
            const OwnShare* own = nullptr);

  /// From here on drag follows from the velocity without what each particle gives it by its own drag,
  /// closures::own_wake: for particles so few that no neighbour feels the same.
  void see_past_own_wake(const OwnWake& wake) { wake_ = wake; }

  /// Whether drag asks for sum phi_j/D_j^2 around a particle.
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
  std::vector<double> creeping_;  ///< 3 pi mu D of each species, over the divisor of a gas that slips, kg/s
  double largest_, fluid_density_, viscosity_;
  bool needs_squares_ = false;
  closures::GuardCount count_;
  std::uint64_t clamped_ = 0;
  std::optional<OwnWake> wake_;
  Batch batch_;
};

}  // namespace polybed::dem
