#include "tfm/effects/table_file.hpp"

#include "core/start_error.hpp"
#include "fluid/shear_regime.hpp"

namespace polybed::tfm {

void require_regime(const core::Scene& scene, const std::string& role, const std::string& file,
                    const std::string& regime) {
  const fluid::Regime here = fluid::shear_regime(scene);
  if (here.name.empty() || here.name == regime) return;
  throw core::StartError("effects." + role + " = \"table:" + file + "\" is a " + regime +
                         " table, and the solids here are " + here.name + ": " + here.reason +
                         " (calibrate.regime says otherwise)");
}

}  // namespace polybed::tfm
