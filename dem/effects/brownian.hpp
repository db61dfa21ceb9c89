// Heat motion of small spheres, Langevin 1908.
#pragma once

#include <cstdint>

#include "dem/effects/side_forces.hpp"

namespace polybed::dem {

/// A random force on each particle, drawn anew in the middle of every step and held until that of the next: of mean 0
/// and variance 2 k_B T k/dt along each axis, k the drag over the slip. Under the exact drag a sphere then diffuses
/// with D = k_B T/k whatever the step. At the ends of steps, in the middle of a hold, its speed has the variance (k_B
/// T/M)(2/x)(a (1 - a)/(1 + a) + (1 - sqrt(a))^2), x = k dt/M, a = exp(-x): that of equipartition less a share of x/2.
/// What a particle is given is taken from the fluid, whose own fluctuations are left out. Draws belong to a particle
/// and its count of steps: the same on any number of ranks.
class Brownian final : public SideForce {
 public:
  /// \param temperature  K  \param dt  of the particles, s  \param place  of the count of draws in a row
  Brownian(double temperature, std::uint64_t seed, double dt, std::size_t place)
      : temperature_(temperature), seed_(seed), dt_(dt), place_(place) {}
  [[nodiscard]] std::size_t memory_size() const override { return 1; }
  void begin(const SideView& view, SideRows& rows) override;
  void end_interval(const SideView& view, SideRows& rows) override;
  void add(const SideView& view, SideRows& rows) override;

 private:
  double temperature_;
  std::uint64_t seed_;
  double dt_;
  std::size_t place_;
};

}  // namespace polybed::dem
