#include "dem/rules.hpp"

#include "dem/effects/maker.hpp"
#include "relevance/effect_rules.hpp"

namespace polybed::dem {

std::vector<core::Rule> key_rules() {
  return relevance::joined(
      {rules_of_keys(),
       {{{"dem.held", "fluid.name", "effects.drag"},
         "dem.held = true without drag: nothing resists the flow through the bed; name a law in effects.drag",
         [](const core::Scene& scene) {
           return core::broken_if(scene.bed.held && scene.fluid.present() && !scene.effects.contains("drag"));
         }}}});
}

}  // namespace polybed::dem
