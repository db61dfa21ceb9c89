// What the laws of particles need beside their names.
#include <fmt/format.h>

#include "dem/effects.hpp"

namespace polybed::dem {

namespace {

using core::SceneFault;
using Faults = std::vector<SceneFault>;

/// The law of a role if a case has chosen one, else "none".
std::string chosen(const core::Scene& scene, const char* role) {
  const std::string law = core::law_of(scene, role);
  return law == core::automatic ? "none" : law;
}

void add_forces(const core::Scene& scene, Faults& faults) {
  if (const std::string law = chosen(scene, "history"); law != "none" && scene.dem.held)
    faults.push_back({"effects.history",
                      {"dem.held"},
                      "effects.history = \"" + law +
                          "\" is a force on particles that accelerate, and dem.held holds them: leave one out"});
  const std::string heat = chosen(scene, "brownian");
  if (heat == "none") return;
  const std::string named = "effects.brownian = \"" + heat + "\"";
  if (!scene.fluid.temperature)
    faults.push_back({"effects.brownian",
                      {"fluid.name", "fluid.temperature"},
                      "fluid.temperature: " + named + " needs it, as in \"20 degC\""});
  if (scene.dem.held || core::law_of(scene, "drag") == "none")
    faults.push_back(
        {"effects.brownian",
         {"effects.drag", "dem.held"},
         named + " moves particles against their drag: name a law of effects.drag, and leave out dem.held"});
}

void add_contact(const core::Scene& scene, Faults& faults) {
  const std::string contact = chosen(scene, "contact");
  const core::Tangential tangential = scene.dem.tangential;
  if (contact == "linear" && !scene.dem.normal_stiffness)
    faults.push_back({"effects.contact",
                      {"dem.normal_stiffness"},
                      "dem.normal_stiffness: effects.contact = \"linear\" needs it, as in \"1000 N/m\""});
  if (contact == "linear" &&
      (tangential == core::Tangential::mindlin || tangential == core::Tangential::mindlin_deresiewicz))
    faults.push_back({"dem.tangential",
                      {"effects.contact"},
                      "dem.tangential = \"" + std::string(core::name_of(tangential)) +
                          "\" needs the radius of a contact, which effects.contact = \"linear\" has not: use "
                          "hertz_mindlin, or dem.tangential = \"linear\""});
  if (contact == "hertz_mindlin" && tangential == core::Tangential::linear)
    faults.push_back({"dem.tangential",
                      {"effects.contact"},
                      "dem.tangential = \"linear\" is a share of dem.normal_stiffness: it goes with effects.contact = "
                      "\"linear\""});
}

void add_rolling(const core::Scene& scene, Faults& faults) {
  const std::string law = chosen(scene, "rolling");
  if (law != "none" && !(scene.dem.rolling_friction > 0))
    faults.push_back({"effects.rolling",
                      {"dem.rolling_friction"},
                      "dem.rolling_friction: effects.rolling = \"" + law + "\" needs it, above 0"});
  if (law == "cdt" && scene.dem.rolling_damping > 0)
    faults.push_back({"dem.rolling_damping",
                      {"effects.rolling"},
                      "dem.rolling_damping: effects.rolling = \"cdt\" has no spring to damp; use epsd"});
}

void add_cohesion(const core::Scene& scene, Faults& faults) {
  const std::string law = chosen(scene, "cohesion");
  if (law == "van_der_waals" && !(scene.dem.hamaker_constant > 0))
    faults.push_back({"effects.cohesion",
                      {"dem.hamaker_constant"},
                      "dem.hamaker_constant: effects.cohesion = \"van_der_waals\" needs it, as in 1e-19"});
  if ((law == "dmt" || law == "jkr") && !(scene.dem.cohesion_energy > 0))
    faults.push_back({"effects.cohesion",
                      {"dem.cohesion_energy"},
                      "dem.cohesion_energy: effects.cohesion = \"" + law + "\" needs it, as in \"50 mJ/m2\""});
}

}  // namespace

std::vector<core::SceneFault> effect_faults(const core::Scene& scene) {
  Faults faults;
  add_forces(scene, faults);
  add_contact(scene, faults);
  add_rolling(scene, faults);
  add_cohesion(scene, faults);
  return faults;
}

}  // namespace polybed::dem
