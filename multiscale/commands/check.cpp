// polybed check: the case, resolved, and what it will need; nothing is run.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "closures/drag.hpp"
#include "closures/terminal_velocity.hpp"
#include "core/case_file.hpp"
#include "core/json.hpp"
#include "core/timers.hpp"
#include "multiscale/commands/options.hpp"
#include "multiscale/roles.hpp"
#include "tfm/model.hpp"

namespace polybed::multiscale {

namespace {

/// Numbers that follow from a case.
struct Derived {
  fluid::FluidConstants fluid;
  std::string integrator, reason;
  std::size_t unknowns = 0;
  double weight = 0;  ///< buoyant weight of the solids per area, Pa
  double max_packing = 0;
  double sound = 0;  ///< speed in a compressible fluid, m/s
  std::vector<double> terminal, reynolds;
  std::vector<std::string> notes;
};

void note_drag(const core::Scene& scene, Derived& derived) {
  const auto named = scene.effects.find("drag");
  if (named == scene.effects.end()) {
    derived.notes.push_back("drag is off: nothing couples the solids to the fluid");
    return;
  }
  for (const closures::DragLawInfo& law : closures::drag_laws())
    if (law.name == named->second && !law.obeys_sum_rule && scene.species.size() > 1)
      derived.notes.push_back("drag = \"" + law.name +
                              "\" acts on each species by itself and breaks the sum rule of mixtures, "
                              "T(3.45): the pressure drop is not exact");
}

Derived derive(const core::Scene& scene) {
  core::Timers timers;
  const tfm::Model model(scene, timers);
  const tfm::Constants& constants = model.constants();
  Derived derived;
  derived.fluid = constants.fluid;
  if (scene.fluid.equation_of_state != "incompressible")
    derived.sound = fluid::speed_of_sound(fluid::equation_of_state(scene.fluid, constants.fluid.density),
                                          scene.fluid.outlet_pressure);
  derived.integrator = model.integrator_name();
  derived.reason = model.integrator_reason();
  derived.unknowns = model.unknowns();
  if (model.effects().solids_stress) derived.max_packing = model.effects().solids_stress->max_packing();
  double fastest = 0;
  for (const auto& point : scene.inlet.superficial_velocity) fastest = std::max(fastest, std::abs(point.second));
  for (std::size_t j = 0; j < constants.species(); ++j) {
    const double excess = constants.density[j] - constants.fluid.density;
    derived.weight +=
        scene.bed.volume_share[j] * scene.bed.static_height * scene.bed.solids_fraction * excess * constants.gravity;
    derived.terminal.push_back(closures::terminal_velocity(
        [](double eps, double re) { return closures::DragSchillerNaumann{}(eps, re).f; }, constants.diameter[j], excess,
        constants.fluid.density, constants.fluid.viscosity, constants.gravity));
    derived.reynolds.push_back(constants.fluid.density * fastest * constants.diameter[j] / constants.fluid.viscosity);
    if (fastest > derived.terminal[j])
      derived.notes.push_back(
          fmt::format("the inlet's {:.4g} m/s is above the terminal velocity of {}, {:.4g} m/s: it will be "
                      "carried to the top",
                      fastest, constants.name[j], derived.terminal[j]));
  }
  note_drag(scene, derived);
  for (const core::Role& role : all_roles())
    if (scene.effects.contains(role.name) && role.models.find("tfm") == std::string::npos)
      derived.notes.push_back(role.name + " = \"" + scene.effects.at(role.name) + "\": " + role.absent);
  return derived;
}

}  // namespace

void run_check(const CaseOptions& options) {
  const core::Scene scene = core::read_case(options.case_path, options.overrides, all_roles());
  const Derived derived = derive(scene);
  const std::string text = core::resolved_case(scene);
  constexpr double bytes_per_unknown = 400;  // state, work fields and the integrator's vectors, measured
  const double memory = 1e-6 * bytes_per_unknown * double(derived.unknowns);
  if (options.json) {
    core::Json json;
    json.begin_object().member("case", text).member("hash", core::text_hash(text));
    json.member("fluid_density_kg_m3", derived.fluid.density).member("fluid_viscosity_Pa_s", derived.fluid.viscosity);
    if (derived.sound > 0) json.member("speed_of_sound_m_s", derived.sound);
    json.member("integrator", derived.integrator).member("unknowns", std::uint64_t(derived.unknowns));
    json.member("memory_MB", memory).member("buoyant_weight_Pa", derived.weight);
    json.key("notes").begin_array();
    for (const std::string& note : derived.notes) json.value(note);
    json.end_array().end_object();
    fmt::print("{}\n", json.text());
    return;
  }
  fmt::print("{}\n", text);
  fmt::print("# fluid: density {:.6g} kg/m3, viscosity {:.6g} Pa s\n", derived.fluid.density, derived.fluid.viscosity);
  if (derived.sound > 0) fmt::print("# sound in the fluid {:.5g} m/s\n", derived.sound);
  for (std::size_t j = 0; j < scene.species.size(); ++j)
    fmt::print("# {}: terminal velocity {:.4g} m/s, Re of the inlet {:.4g}\n", scene.species[j].name,
               derived.terminal[j], derived.reynolds[j]);
  fmt::print("# buoyant weight of the bed {:.5g} Pa per area\n", derived.weight);
  if (derived.max_packing > 0) fmt::print("# maximum packing {:.4f}\n", derived.max_packing);
  fmt::print("# {} unknowns, about {:.0f} MB; integrator {} ({})\n", derived.unknowns, std::max(memory, 1.0),
             derived.integrator, derived.reason);
  for (const std::string& note : derived.notes) fmt::print("# {}\n", note);
}

}  // namespace polybed::multiscale
