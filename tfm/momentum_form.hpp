// Which form the convection of momentum takes, and why: as the case says, or by the densities.
#pragma once

#include <string>

#include "core/scene.hpp"

namespace polybed::tfm {

struct MomentumForm {
  std::string name;  ///< upwind | limited | conservative | conservative_limited
  std::string reason;
};

/// "auto" is "conservative" where the densest species is more than ten times as dense as the fluid, else "upwind".
/// (U.grad)U takes to the solids below what thin solids above them have in velocity, not in momentum: next to nothing
/// where the fluid holds falling solids back as a liquid does, up to the weight of the bed and more in a gas. Measured
/// in beds of 1.4 and of 900 to 6500 times the fluid's density (docs/cost.md); few beds are near ten.
[[nodiscard]] MomentumForm momentum_form(const core::Scene& scene);

}  // namespace polybed::tfm
