// History force of spheres, closures/history_basset.hpp: Basset's kernel, creeping flow.
#pragma once

#include <vector>

#include "closures/history_basset.hpp"
#include "dem/effects/side_forces.hpp"

namespace polybed::dem {

/// Stepped once in a step of the fluid: g is the change of slip over it, so that a collision enters by its impulse
/// however short it is. For a g that is constant in each step the weights give the mean of the force over a step
/// exactly, 4/3 sqrt(h) [(n+1)^1.5 - 2 n^1.5 + (n-1)^1.5]: momentum is right, and the start from rest is a past of
/// zeros. The newest g holds the particle's own acceleration: its coefficient is an inertia, beside added mass and with
/// the same acceleration of the fluid, DU_f/Dt; older terms have the slip's where the particle goes. Slip that is there
/// at the start of a run counts as old: its vorticity has spread.
///
/// Window of 4 steps: the exponentials err by 0.126 % wherever the window ends, and up to 1e5 windows; its length only
/// decides how long a run remembers its start, 4e5 steps of the fluid.
class History final : public SideForce {
 public:
  /// \param density, viscosity  of the fluid, kg/m3, Pa s  \param interval  step of the fluid, s
  /// \param place  of its memory in a row  \param beside  other inertia is in the loads: added mass
  History(const Materials& materials, double density, double viscosity, double interval, std::size_t place,
          bool beside);
  [[nodiscard]] bool has_inertia() const override { return true; }
  [[nodiscard]] std::size_t memory_size() const override { return memory; }
  void begin(const SideView& view, SideRows& rows) override;
  void end_interval(const SideView& view, SideRows& rows) override;
  void add(const SideView& view, SideRows& rows) override;

 private:
  static constexpr std::size_t window = 4;
  /// In a row: the slip when the step of the fluid began, the sum of the past, g of the window, sums of the tail.
  static constexpr std::size_t slip = 0, sum = 3, past = 6, tail = past + 3 * window,
                               memory = tail + 3 * closures::BassetTail::terms;

  closures::BassetWeights<window> weights_;
  std::vector<double> prefactor_;  ///< B of each species, kg/s^(1/2)
  std::size_t place_;
  double interval_, others_;  ///< s; share of the inertia of others: 1, or 0 where there is none
};

}  // namespace polybed::dem
