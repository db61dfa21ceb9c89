#include "relevance/effects/species_exchange.hpp"

#include "core/start_error.hpp"
#include "fluid/solids_table.hpp"
#include "tfm/effects/maker.hpp"
#include "tfm/effects/species_exchange_syamlal.hpp"
#include "tfm/effects/species_exchange_table.hpp"
#include "tfm/effects/table_file.hpp"

namespace polybed::tfm::makers {

namespace {

/// A table of what two species exchange, which has to be of dry boxes and for a scene that is dry.
fluid::SolidsTable exchange_table(const core::Scene& scene, const std::string& file,
                                  std::vector<std::string>& warnings) {
  if (const core::BoxRegime regime = fluid::regime_of_table(file); regime != core::BoxRegime::dry)
    throw core::StartError("effects.species_exchange = \"table:" + file + "\" is a " +
                           std::string(core::name_of(regime)) +
                           " table: what species exchange is measured in dry boxes alone");
  require_regime(scene, "species_exchange", file, core::BoxRegime::dry);
  fluid::SolidsTable table = fluid::read_solids_table(file);
  for (const std::string& line : fluid::beyond(table, fluid::place_of(scene)))
    warnings.push_back("species exchange " + file + ": " + line);
  return table;
}

void make_species_exchange(const Making& m) {
  const auto& [scene, constants, boundaries, law, fields, effects] = m;
  if (const auto file = table_file(law)) {
    const fluid::SolidsTable table = exchange_table(scene, *file, effects.warnings);
    effects.species_exchange = std::make_unique<TableExchange>(scene, constants, boundaries, table, *file, fields);
  } else if (constants.species() > 1) {
    effects.species_exchange = std::make_unique<SyamlalExchange>(scene, constants, boundaries, fields);
  }
}

}  // namespace

extern const Maker species_exchange;
const Maker species_exchange{&relevance::effects::species_exchange, "Exchange", make_species_exchange, {"syamlal"}};

}  // namespace polybed::tfm::makers
