// The solids' equations where the solids are, not in the whole column.
#pragma once

#include "tfm/right_hand_side.hpp"
#include "tfm/step_part.hpp"

namespace polybed::tfm {

/// They are evaluated below the highest row that contains solids, and in some rows above, where their velocities have
/// time to become those of the flow before solids arrive. It depends on the state alone, as a restart needs.
class FollowBed : public StepPart {
 public:
  FollowBed(RightHandSide& equations, const StateLayout& layout) : equations_(equations), layout_(layout) {}
  void prepare(std::span<const double> y) override;

 private:
  RightHandSide& equations_;
  const StateLayout& layout_;
};

}  // namespace polybed::tfm
