#include "dem/effects.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "dem/effects/contact_hertz.hpp"
#include "dem/effects/contact_linear.hpp"
#include "dem/effects/friction.hpp"

namespace polybed::dem {

namespace {

std::string law_of(const core::Scene& scene, const std::string& role) {
  const auto found = scene.effects.find(role);
  return found == scene.effects.end() ? "none" : found->second;
}

std::unique_ptr<TangentialLaw> make_tangential(const core::Scene& scene, const Materials& materials) {
  if (law_of(scene, "contact") == "hertz") return nullptr;
  if (law_of(scene, "contact") == "linear")
    return std::make_unique<SpringFriction>(materials, scene.dem.normal_stiffness.value(), scene.dem.tangential_ratio);
  if (scene.dem.tangential == "mindlin") return std::make_unique<MindlinFriction>(materials);
  return std::make_unique<SpringFriction>(materials);
}

}  // namespace

PairLaws make_pair_laws(const core::Scene& scene, const Materials& materials) {
  PairLaws laws;
  const std::string contact = law_of(scene, "contact");
  if (contact == "none")
    throw core::CaseError("effects.contact: particles need a law of contact: hertz_mindlin, hertz or linear");
  if (contact == "linear") {
    if (!scene.dem.normal_stiffness)
      throw core::CaseError("dem.normal_stiffness: effects.contact = \"linear\" needs it, as in \"1000 N/m\"");
    laws.normal = std::make_unique<LinearContact>(materials, *scene.dem.normal_stiffness, scene.dem.tail);
  } else {
    laws.normal = std::make_unique<HertzContact>(materials, scene.dem.tail);
  }
  laws.tangential = make_tangential(scene, materials);
  return laws;
}

std::vector<core::Role> roles() {
  return {{"contact",
           "dem",
           "Pair",
           "forces of touching particles",
           "DEM only; reaches the TFM through the solids stress",
           {{"hertz_mindlin", "Hertz's normal force and friction by dem.tangential"},
            {"hertz", "Hertz's normal force alone: no friction, no rotation"},
            {"linear", "linear springs, dem.normal_stiffness"}}}};
}

}  // namespace polybed::dem
