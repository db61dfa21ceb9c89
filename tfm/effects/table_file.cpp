#include "tfm/effects/table_file.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "fluid/shear_regime.hpp"

namespace polybed::tfm {

void require_regime(const core::Scene& scene, const std::string& role, const std::string& file,
                    core::BoxRegime regime) {
  const fluid::Regime here = fluid::shear_regime(scene);
  if (here.kind == core::BoxRegime::automatic || here.kind == regime) return;
  throw core::StartError(fmt::format(
      "effects.{} = \"table:{}\" is a {} table, and the solids here are {}: {} (calibrate.regime says otherwise)", role,
      file, core::name_of(regime), core::name_of(here.kind), here.reason));
}

}  // namespace polybed::tfm
