// The flow behind a jump of the inlet's velocity.
#pragma once

#include "tfm/right_hand_side.hpp"
#include "tfm/step_part.hpp"

namespace polybed::tfm {

/// Where the inlet jumps at a time, s, from `before`, an impulse brings fluxes and velocities to the new value at once,
/// with the operator that the pressure uses. Nothing happens to a jump below 1e-9 of a velocity scale, m/s. Collective.
/// \param before  the inlet's velocity on the bottom faces of a field that is 0 elsewhere, m/s
void project_jump(RightHandSide& equations, const StateLayout& layout, double velocity_scale, double time,
                  const core::Field& before, std::span<double> y);

/// Of an incompressible fluid: one that is compressible learns of a jump by sound.
class InletJump : public StepPart {
 public:
  InletJump(RightHandSide& equations, const StateLayout& layout, double velocity_scale)
      : equations_(equations), layout_(layout), velocity_scale_(velocity_scale) {}
  void restart(double time, std::span<double> y) override;

 private:
  RightHandSide& equations_;
  const StateLayout& layout_;
  double velocity_scale_;
};

}  // namespace polybed::tfm
