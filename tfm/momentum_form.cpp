#include "tfm/momentum_form.hpp"

namespace polybed::tfm {

MomentumForm momentum_form(const core::Scene& scene) {
  if (scene.scheme.momentum != core::Momentum::automatic) return {scene.scheme.momentum, "as the case says"};
  return {core::Momentum::conservative, "(U.grad)U would show beds heavier than they are"};
}

}  // namespace polybed::tfm
