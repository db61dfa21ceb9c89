#include "tfm/momentum_form.hpp"

#include <algorithm>

#include "fluid/properties.hpp"

namespace polybed::tfm {

MomentumForm momentum_form(const core::Scene& scene) {
  if (scene.tfm.momentum != "auto") return {scene.tfm.momentum, "as the case says"};
  constexpr double heavy = 10;
  double densest = 0;
  for (const core::Species& species : scene.species) densest = std::max(densest, species.density);
  if (densest > heavy * fluid::fluid_constants(scene.fluid).density)
    return {"conservative", "solids more than ten times as dense as the fluid: (U.grad)U would lose their momentum"};
  return {"upwind", "solids less than ten times as dense as the fluid: (U.grad)U is cheaper"};
}

}  // namespace polybed::tfm
