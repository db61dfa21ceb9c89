#include "multiscale/roles.hpp"

#include "tfm/effects.hpp"

namespace polybed::multiscale {

std::vector<core::Role> all_roles() {
  std::vector<core::Role> roles = tfm::roles();
  // One case file describes a scene for both models, so a case may say how its particles touch.
  roles.push_back(
      {"contact",
       "dem",
       "Pair",
       "forces of touching particles",
       "DEM only; reaches the TFM through the solids stress",
       {{"hertz_mindlin", "Hertz and Mindlin"}, {"hertz", "normal force alone"}, {"linear", "linear springs"}}});
  return roles;
}

}  // namespace polybed::multiscale
