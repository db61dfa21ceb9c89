#include "tfm/effects.hpp"

#include <string_view>

#include "closures/drag.hpp"
#include "core/error.hpp"
#include "tfm/effects/drag.hpp"
#include "tfm/effects/fluid_stress_newtonian.hpp"
#include "tfm/effects/solids_stress_frictional.hpp"
#include "tfm/effects/solids_stress_kinetic.hpp"
#include "tfm/effects/solids_stress_table.hpp"
#include "tfm/effects/solids_viscosity_frictional.hpp"
#include "tfm/effects/solids_wall_johnson_jackson.hpp"
#include "tfm/effects/species_exchange_syamlal.hpp"

namespace polybed::tfm {

std::vector<core::Role> roles() {
  core::Role drag{"drag", "tfm, dem", "Exchange", "force of the fluid on every species or particle", "", {}};
  for (const closures::DragLawInfo& law : closures::drag_laws())
    drag.laws.push_back({law.name, law.help + (law.obeys_sum_rule ? "" : " [of a mixture: breaks the sum rule]")});
  return {drag,
          {"fluid_stress",
           "tfm, dem",
           "Stress",
           "viscous stress of the averaged fluid",
           "",
           {{"newtonian", "mu (grad U + grad U^T - 2/3 div U I); T(1.16)"}}},
          {"solids_stress",
           "tfm",
           "Stress",
           "pressure of the solids, packed or in collision",
           "particles have contacts instead",
           {{"frictional", "Johnson and Jackson 1987, with bulk viscosity"},
            {"kinetic", "the same, and kinetic theory of collisions: pressure and viscosity"},
            {"table:FILE", "frictional, and the pressure of a fluidised bed from a file of regime \"bed\""}}},
          {"granular_temperature",
           "tfm",
           "Scalar",
           "fluctuations that the kinetic stress rests on",
           "particles have velocities of their own",
           {{"algebraic", "production, collisions and drag in balance; the default with solids_stress = kinetic"},
            {"transported", "one equation for each species"}}},
          {"solids_viscosity",
           "tfm",
           "Stress",
           "resistance of packed solids to shear",
           "particles have contacts instead",
           {{"schaeffer", "p_f sin(delta)/abs(gamma), capped; Schaeffer 1987"},
            {"mu_i", "mu(I) p_f/abs(gamma), capped; Jop, Forterre and Pouliquen 2006, dry grains"}}},
          {"species_exchange",
           "tfm",
           "Exchange",
           "momentum that solid species exchange by contact",
           "particles have contacts instead",
           {{"syamlal", "collisions, Syamlal 1987; contact in a packed bed, Gera 2004"}}}};
}

namespace {

[[noreturn]] void refuse(const char* role, const std::string& name) {
  throw core::CaseError(std::string("effects.") + role + " = \"" + name +
                        "\": not in the continuum model; see polybed list");
}

/// All that fills the slot Stress of the solids, in the order in which it is evaluated.
void make_solids_stress(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                        Fields& fields, Effects& effects) {
  constexpr std::string_view table = "table:";
  const std::string stress = core::law_of(scene, "solids_stress"), viscosity = core::law_of(scene, "solids_viscosity"),
                    temperature = core::law_of(scene, "granular_temperature");
  if (stress == "frictional" || stress == "kinetic")
    effects.solids_stress = std::make_unique<FrictionalStress>(scene, constants, boundaries, fields);
  else if (stress.starts_with(table))
    effects.solids_stress =
        std::make_unique<TableStress>(scene, constants, boundaries, stress.substr(table.size()), fields);
  else if (stress != "none")
    refuse("solids_stress", stress);
  if (viscosity == "schaeffer" || viscosity == "mu_i") {
    if (!effects.solids_stress)
      throw core::CaseError("effects.solids_viscosity = \"" + viscosity + "\" needs a solids_stress: its pressure");
    effects.solids_viscosity = std::make_unique<FrictionalViscosity>(scene, constants, viscosity, fields);
  } else if (viscosity != "none") {
    refuse("solids_viscosity", viscosity);
  }
  if (stress == "kinetic")
    effects.collisions = std::make_unique<KineticStress>(scene, constants, boundaries, temperature == "transported",
                                                         effects.solids_stress->max_packing(), fields);
  else if (temperature != "none")
    throw core::CaseError("effects.granular_temperature = \"" + temperature +
                          "\" acts only with solids_stress = \"kinetic\"");
  if (scene.tfm.solids_wall == "johnson_jackson")
    effects.solids_wall = std::make_unique<JohnsonJacksonWall>(scene, constants, boundaries, fields);
}

}  // namespace

Effects make_effects(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                     Fields& fields) {
  Effects effects;
  if (const std::string name = core::law_of(scene, "drag"); name != "none")
    effects.drag = std::make_unique<Drag>(constants, boundaries, name);
  if (const std::string name = core::law_of(scene, "fluid_stress"); name == "newtonian")
    effects.fluid_stress = std::make_unique<NewtonianStress>(constants, boundaries);
  else if (name != "none")
    refuse("fluid_stress", name);
  make_solids_stress(scene, constants, boundaries, fields, effects);
  if (const std::string name = core::law_of(scene, "species_exchange"); name == "syamlal") {
    if (constants.species() > 1)
      effects.species_exchange = std::make_unique<SyamlalExchange>(scene, constants, boundaries, fields);
  } else if (name != "none") {
    refuse("species_exchange", name);
  }
  if (scene.fluid.equation_of_state != "incompressible") {
    const double density = constants.fluid.density;
    effects.compressible = std::make_unique<fluid::Compressible>(
        constants.grid, boundaries, fluid::equation_of_state(scene.fluid, density), scene.fluid.outlet_pressure,
        density, constants.gravity);
    effects.compressible->make_fields(fields.fluid);
  }
  return effects;
}

}  // namespace polybed::tfm
