#include "dem/continuum_scene.hpp"

namespace polybed::dem {

const std::vector<core::Rule>& model_rules() {
  static const std::vector<core::Rule> all{
      {{"column.outlet"},
       "column.outlet = \"open\" is for the TFM only: particles leave through dem.opening, where there is no fluid; "
       "use "
       "\"screen\", which holds them",
       [](const core::Scene& scene) { return core::broken_if(scene.column.outlet == core::Outlet::open); }},
      {{"feed.species"},
       "[[feed]] is for the TFM only: particles cannot enter the column yet; give them all in [bed]",
       [](const core::Scene& scene) { return core::broken_if(!scene.feeds.empty()); }}};
  return all;
}

std::vector<std::string> only_for_continuum(const core::Scene& scene) {
  std::vector<std::string> found;
  for (const core::Rule& rule : model_rules())
    for (std::string& fault : rule.faults(scene)) found.push_back(std::move(fault));
  return found;
}

void refuse_continuum_scene(const core::Scene& scene) { core::refuse(model_rules(), scene); }

}  // namespace polybed::dem
