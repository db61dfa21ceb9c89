// Which form the convection of momentum takes, and why: as the case says, or the one that keeps momentum.
#pragma once

#include <string>

#include "core/case/scene.hpp"

namespace polybed::tfm {

struct MomentumForm {
  core::Momentum form{};  ///< not automatic
  std::string reason;
};

/// automatic is conservative. (U.grad)U takes to the solids below what thin solids above them have in velocity, not in
/// momentum: up to the weight of the bed and more in a gas, 2 to 5 % of it in a liquid bed that stirs itself, which is
/// enough to decide which species lies on top (docs/record/cost.md).
[[nodiscard]] MomentumForm momentum_form(const core::Scene& scene);

}  // namespace polybed::tfm
