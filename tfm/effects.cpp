#include "tfm/effects.hpp"

#include <string_view>

#include "closures/drag.hpp"
#include "closures/stress_reference.hpp"
#include "core/error.hpp"
#include "fluid/gas_slip.hpp"
#include "fluid/shear_regime.hpp"
#include "fluid/solids_table.hpp"
#include "tfm/effects/drag.hpp"
#include "tfm/effects/fluid_stress_newtonian.hpp"
#include "tfm/effects/solids_stress_frictional.hpp"
#include "tfm/effects/solids_stress_kinetic.hpp"
#include "tfm/effects/solids_stress_table.hpp"
#include "tfm/effects/solids_stress_wet.hpp"
#include "tfm/effects/solids_viscosity_frictional.hpp"
#include "tfm/effects/solids_wall_johnson_jackson.hpp"
#include "tfm/effects/species_exchange_syamlal.hpp"
#include "tfm/effects/species_exchange_table.hpp"

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
          {"gas_slip",
           "tfm, dem",
           "Exchange",
           "slip of a rarefied gas on small spheres, which lowers their drag",
           "",
           {{"cunningham", "drag over 1 + Kn (1.257 + 0.4 exp(-1.1/Kn)), at the outlet's pressure; Davies 1945"}}},
          {"solids_stress",
           "tfm",
           "Stress",
           "pressure of the solids, packed or in collision",
           "particles have contacts instead",
           {{"frictional", "Johnson and Jackson 1987, with bulk viscosity"},
            {"kinetic", "the same, and kinetic theory of collisions: pressure and viscosity"},
            {"table:FILE",
             "frictional, and what polybed calibrate measured: of a fluidised bed, or of sheared particles"}}},
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
           {{"syamlal", "collisions, Syamlal 1987; contact in a packed bed, Gera 2004"},
            {"table:FILE", "of collisions, as polybed calibrate measured it in dry boxes"}}}};
}

namespace {

/// How the name of a law begins that is a table in a file.
constexpr std::string_view table_word = "table:";

[[noreturn]] void refuse(const char* role, const std::string& name) {
  throw core::CaseError(std::string("effects.") + role + " = \"" + name +
                        "\": not in the continuum model; see polybed list");
}

/// A table of sheared particles has to be of the scene's regime: the other misses the stress by factors.
void require_regime(const core::Scene& scene, const std::string& role, const std::string& file,
                    const std::string& regime) {
  const fluid::Regime here = fluid::shear_regime(scene);
  if (here.name.empty() || here.name == regime) return;
  throw core::CaseError("effects." + role + " = \"table:" + file + "\" is a " + regime +
                        " table, and the solids here are " + here.name + ": " + here.reason +
                        " (calibrate.regime says otherwise)");
}

/// The stress of a table: friction, a fluidised bed's pressure if the file has it, and that of sheared particles.
void make_table_stress(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                       const std::string& file, Fields& fields, Effects& effects) {
  const std::string regime = fluid::regime_of_table(file);
  if (const std::string line = fluid::missing_checksum(file); !line.empty()) effects.warnings.push_back(line);
  if (regime == "bed") {
    effects.solids_stress =
        std::make_unique<TableStress>(scene, constants, boundaries, read_bed_pressure(file), file, fields);
    return;
  }
  const fluid::SolidsTable table = fluid::read_solids_table(file);
  require_regime(scene, "solids_stress", file, regime);
  if (table.bed.phi.empty())
    effects.solids_stress = std::make_unique<FrictionalStress>(scene, constants, boundaries, fields);
  else
    effects.solids_stress =
        std::make_unique<TableStress>(scene, constants, boundaries, bed_curve(table.bed, file), file, fields);
  const fluid::TablePlace place = fluid::place_of(scene);
  for (const std::string& line : fluid::beyond(table, place))
    effects.warnings.push_back("solids stress " + file + ": " + line);
  closures::StressRatios ratios = fluid::ratios_at(table, place);
  if (regime == "wet") {
    effects.collisions =
        std::make_unique<WetStress>(constants, boundaries, std::move(ratios),
                                    closures::jamming_fraction(place.friction), table.inertia, file, fields);
    return;
  }
  const bool transported = core::law_of(scene, "granular_temperature") == "transported";
  auto kinetic = std::make_unique<KineticStress>(scene, constants, boundaries, transported,
                                                 effects.solids_stress->max_packing(), fields);
  std::vector<double> restitution;
  for (const core::Species& s : scene.species) {
    const double e = s.restitution.value_or(scene.dem.restitution), friction = s.friction.value_or(scene.dem.friction);
    restitution.push_back(table.reference_restitution(e, friction));
    if (!(restitution.back() > 0))
      throw core::CaseError(file + ": a restitution of " + std::to_string(e) + " with a friction of " +
                            std::to_string(friction) + " is beyond e - 1.5 mu exp(-3 mu), which the table is over");
  }
  kinetic->multiply(std::move(ratios), std::move(restitution), file);
  effects.collisions = std::move(kinetic);
}

/// All that fills the slot Stress of the solids, in the order in which it is evaluated.
void make_solids_stress(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                        Fields& fields, Effects& effects) {
  const std::string stress = core::law_of(scene, "solids_stress"), viscosity = core::law_of(scene, "solids_viscosity"),
                    temperature = core::law_of(scene, "granular_temperature");
  if (stress == "frictional" || stress == "kinetic")
    effects.solids_stress = std::make_unique<FrictionalStress>(scene, constants, boundaries, fields);
  else if (stress.starts_with(table_word))
    make_table_stress(scene, constants, boundaries, stress.substr(table_word.size()), fields, effects);
  else if (stress != "none")
    refuse("solids_stress", stress);
  if (viscosity == "schaeffer" || viscosity == "mu_i")
    effects.solids_viscosity = std::make_unique<FrictionalViscosity>(scene, constants, viscosity, fields);
  else if (viscosity != "none")
    refuse("solids_viscosity", viscosity);
  if (stress == "kinetic")
    effects.collisions = std::make_unique<KineticStress>(scene, constants, boundaries, temperature == "transported",
                                                         effects.solids_stress->max_packing(), fields);
  else if (temperature != "none" && dynamic_cast<KineticStress*>(effects.collisions.get()) == nullptr)
    throw core::CaseError("effects.granular_temperature = \"" + temperature +
                          "\" acts only with solids_stress = \"kinetic\" or a dry table");
  if (scene.tfm.solids_wall == core::SolidsWall::johnson_jackson)
    effects.solids_wall = std::make_unique<JohnsonJacksonWall>(scene, constants, boundaries, fields);
}

/// A table of what two species exchange, which has to be of dry boxes and for a scene that is dry.
fluid::SolidsTable exchange_table(const core::Scene& scene, const std::string& file,
                                  std::vector<std::string>& warnings) {
  if (const std::string regime = fluid::regime_of_table(file); regime != "dry")
    throw core::CaseError("effects.species_exchange = \"table:" + file + "\" is a " + regime +
                          " table: what species exchange is measured in dry boxes alone");
  require_regime(scene, "species_exchange", file, "dry");
  fluid::SolidsTable table = fluid::read_solids_table(file);
  for (const std::string& line : fluid::beyond(table, fluid::place_of(scene)))
    warnings.push_back("species exchange " + file + ": " + line);
  return table;
}

}  // namespace

Effects make_effects(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                     Fields& fields) {
  core::refuse(effect_faults(scene));
  Effects effects;
  if (const std::string name = core::law_of(scene, "drag"); name != "none")
    effects.drag = std::make_unique<Drag>(constants, boundaries, name, fluid::slip_divisors(scene, constants.diameter));
  if (const std::string name = core::law_of(scene, "fluid_stress"); name == "newtonian")
    effects.fluid_stress = std::make_unique<NewtonianStress>(constants, boundaries);
  else if (name != "none")
    refuse("fluid_stress", name);
  make_solids_stress(scene, constants, boundaries, fields, effects);
  if (const std::string name = core::law_of(scene, "species_exchange"); name == "syamlal") {
    if (constants.species() > 1)
      effects.species_exchange = std::make_unique<SyamlalExchange>(scene, constants, boundaries, fields);
  } else if (name.starts_with(table_word)) {
    const std::string file = name.substr(table_word.size());
    const fluid::SolidsTable table = exchange_table(scene, file, effects.warnings);
    effects.species_exchange = std::make_unique<TableExchange>(scene, constants, boundaries, table, file, fields);
  } else if (name != "none") {
    refuse("species_exchange", name);
  }
  if (scene.fluid.compressible()) {
    const double density = constants.fluid.density;
    effects.compressible = std::make_unique<fluid::Compressible>(
        constants.grid, boundaries, fluid::equation_of_state(scene.fluid, density), scene.fluid.outlet_pressure,
        density, constants.gravity);
    effects.compressible->make_fields(fields.fluid);
  }
  return effects;
}

}  // namespace polybed::tfm
