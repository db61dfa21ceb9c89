#include "dem/rules.hpp"

namespace polybed::dem {

std::vector<core::Rule> key_rules() {
  return {{{"dem.held", "fluid.name", "effects.drag"},
           "dem.held = true without drag: nothing resists the flow through the bed; name a law in effects.drag",
           [](const core::Scene& scene) {
             return core::broken_if(scene.dem.held && scene.fluid.present() && !scene.effects.contains("drag"));
           }}};
}

}  // namespace polybed::dem
