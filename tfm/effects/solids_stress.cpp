// Makes the stress of the solids: friction, and what collisions add to it.
#include "relevance/effects/solids_stress.hpp"

#include "closures/stress_reference.hpp"
#include "core/case/laws.hpp"
#include "core/start_error.hpp"
#include "fluid/solids_table.hpp"
#include "relevance/effects/granular_temperature.hpp"
#include "tfm/effects/maker.hpp"
#include "tfm/effects/solids_stress_frictional.hpp"
#include "tfm/effects/solids_stress_kinetic.hpp"
#include "tfm/effects/solids_stress_table.hpp"
#include "tfm/effects/solids_stress_wet.hpp"
#include "tfm/effects/table_file.hpp"

namespace polybed::tfm::makers {

namespace {

/// The stress of a table: friction, a fluidised bed's pressure if the file has it, and that of sheared particles.
void make_table_stress(const Making& m, const std::string& file) {
  const auto& [scene, constants, boundaries, law, fields, effects] = m;
  const core::BoxRegime regime = fluid::regime_of_table(file);
  if (const std::string line = fluid::missing_checksum(file); !line.empty()) effects.warnings.push_back(line);
  if (regime == core::BoxRegime::bed) {
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
  if (regime == core::BoxRegime::wet) {
    effects.collisions =
        std::make_unique<WetStress>(constants, boundaries, std::move(ratios),
                                    closures::jamming_fraction(place.friction), table.inertia, file, fields);
    return;
  }
  const bool transported = relevance::effects::is_transported(scene);
  auto kinetic = std::make_unique<KineticStress>(scene, constants, boundaries, transported,
                                                 effects.solids_stress->max_packing(), fields);
  std::vector<double> restitution;
  for (const core::Species& s : scene.species) {
    restitution.push_back(table.reference_restitution(s.restitution, s.friction));
    if (!(restitution.back() > 0))
      throw core::StartError(file + ": a restitution of " + std::to_string(s.restitution) + " with a friction of " +
                             std::to_string(s.friction) + " is beyond e - 1.5 mu exp(-3 mu), which the table is over");
  }
  kinetic->multiply(std::move(ratios), restitution, file);
  effects.collisions = std::move(kinetic);
}

void make_solids_stress(const Making& m) {
  const relevance::Effect& temperature = relevance::effects::granular_temperature;
  if (const auto file = table_file(m.law)) {
    make_table_stress(m, *file);
  } else {
    m.effects.solids_stress = std::make_unique<FrictionalStress>(m.scene, m.constants, m.boundaries, m.fields);
    if (relevance::effects::solids_stress.law_has(m.law, relevance::effects::kinetic_theory))
      m.effects.collisions = std::make_unique<KineticStress>(m.scene, m.constants, m.boundaries,
                                                             relevance::effects::is_transported(m.scene),
                                                             m.effects.solids_stress->max_packing(), m.fields);
  }
  if (core::acts(m.scene, temperature.role) && dynamic_cast<KineticStress*>(m.effects.collisions.get()) == nullptr)
    throw core::StartError("effects.granular_temperature = \"" + core::law_of(m.scene, temperature.role) +
                           "\" acts only with solids_stress = \"kinetic\" or a dry table");
}

}  // namespace

extern const Maker solids_stress, granular_temperature;
const Maker solids_stress{&relevance::effects::solids_stress, "Stress", make_solids_stress, {"kinetic"}};
const Maker granular_temperature{&relevance::effects::granular_temperature, "Scalar"};

}  // namespace polybed::tfm::makers
