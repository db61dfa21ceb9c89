// What the laws of the continuum need beside their names.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "closures/stress_frictional.hpp"
#include "tfm/effects.hpp"

namespace polybed::tfm {

namespace {

using Faults = std::vector<core::SceneFault>;

/// Whether a scene's solids have a stress with a part from collisions: kinetic, or a table, which may be of either
/// kind.
bool may_collide(const std::string& stress) { return stress == "kinetic" || stress.starts_with("table:"); }

void add_stress(const core::Scene& scene, Faults& faults) {
  const std::string stress = core::law_of(scene, "solids_stress"), viscosity = core::law_of(scene, "solids_viscosity"),
                    temperature = core::law_of(scene, "granular_temperature");
  const auto named = [](const std::string& law) { return law != "none" && law != core::automatic; };
  if (named(viscosity) && stress == "none")
    faults.push_back({"effects.solids_viscosity",
                      {"effects.solids_stress"},
                      "effects.solids_viscosity = \"" + viscosity + "\" needs a solids_stress: its pressure"});
  if (named(temperature) && stress == "none")
    faults.push_back({"effects.granular_temperature",
                      {"effects.solids_stress"},
                      "effects.granular_temperature = \"" + temperature +
                          "\" acts only with solids_stress = \"kinetic\" or a dry table"});
  if (stress == "kinetic" && temperature != "transported")
    for (const core::Species& species : scene.species)
      if (species.restitution.value_or(scene.dem.restitution) >= 1)
        faults.push_back({"effects.solids_stress",
                          {"effects.granular_temperature", "species.restitution", "dem.restitution"},
                          "effects.granular_temperature = \"algebraic\" needs a restitution below 1: species \"" +
                              species.name + "\""});
  if (scene.tfm.solids_wall == core::SolidsWall::johnson_jackson && viscosity == "none" && !may_collide(stress) &&
      stress != core::automatic)
    faults.push_back({"tfm.solids_wall",
                      {"effects.solids_viscosity", "effects.solids_stress"},
                      "tfm.solids_wall = \"johnson_jackson\" acts through a viscosity of the solids: "
                      "effects.solids_viscosity, or effects.solids_stress = \"kinetic\""});
}

void add_packing(const core::Scene& scene, Faults& faults) {
  if (core::law_of(scene, "solids_stress") == "none") return;
  if (scene.tfm.max_packing == core::MaxPacking(core::PackingRule::fedors_landel) && scene.species.size() != 2)
    faults.push_back({"tfm.max_packing",
                      {"species.diameter"},
                      "tfm.max_packing = \"fedors_landel\" is for two species; yu_standish is for any number"});
  const double* most = std::get_if<double>(&scene.tfm.max_packing);
  if (most != nullptr && *most <= scene.tfm.frictional_onset + closures::FrictionalLaw::margin)
    faults.push_back({"tfm.max_packing",
                      {"tfm.frictional_onset"},
                      fmt::format("tfm.max_packing = {} must lie above tfm.frictional_onset = {}", *most,
                                  scene.tfm.frictional_onset)});
}

}  // namespace

std::vector<core::SceneFault> effect_faults(const core::Scene& scene) {
  Faults faults;
  add_stress(scene, faults);
  add_packing(scene, faults);
  return faults;
}

}  // namespace polybed::tfm
