#include "tfm/effects/table_file.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "core/error.hpp"
#include "relevance/effects/solids_stress.hpp"
#include "tfm/effects/solids_stress_table.hpp"
#include "tfm/shear_regime.hpp"
#include "tfm/solids_table.hpp"

namespace polybed::tfm {

namespace {

bool is_left_open(const core::Scene& scene) {
  return scene.drag().name == core::automatic || scene.bed.volume_share.size() != scene.species.size();
}

/// Checks that a table of sheared particles is for the scene's regime: the other regime's stress differs by factors.
std::string wrong_regime(const core::Scene& scene, const std::string& file, core::BoxRegime regime) {
  const Regime here = shear_regime(scene);
  if (here.kind == core::BoxRegime::automatic || here.kind == regime) return "";
  return fmt::format("table:{} is a {} table, and the solids here are {}: {} (calibrate.regime says otherwise)", file,
                     core::name_of(regime), core::name_of(here.kind), here.reason);
}

std::string wrong_restitution(const core::Scene& scene, const std::string& file, const SolidsTable& table) {
  for (const core::Species& s : scene.species)
    if (!(table.reference_restitution(s.restitution, s.friction) > 0))
      return fmt::format(
          "{}: a restitution of {:g} with a friction of {:g} is beyond e - 1.5 mu exp(-3 mu), which the table is over",
          file, s.restitution, s.friction);
  return "";
}

std::string wrong_for_stress(const core::Scene& scene, const std::string& file) {
  const core::BoxRegime regime = regime_of_table(file);
  const bool of_bed = regime == core::BoxRegime::bed;
  if (regime != core::BoxRegime::dry && core::acts(scene, "granular_temperature"))
    return fmt::format("{} is no dry table, with which effects.granular_temperature = \"{}\" could act", file,
                       core::law_of(scene, "granular_temperature"));
  if (of_bed && scene.tfm.solids_wall == core::SolidsWall::johnson_jackson && !core::acts(scene, "solids_viscosity"))
    return file + " has no viscosity of the solids, through which tfm.solids_wall = \"johnson_jackson\" acts";
  if (of_bed) return (void)read_bed_pressure(file), "";
  if (std::string wrong = wrong_regime(scene, file, regime); !wrong.empty()) return wrong;
  const SolidsTable table = read_solids_table(file);
  if (!table.bed.phi.empty()) (void)bed_curve(table.bed, file);
  return regime == core::BoxRegime::dry ? wrong_restitution(scene, file, table) : "";
}

/// Whether the stress has a granular temperature.
bool has_temperature(const core::Scene& scene) {
  const std::string law = core::law_of(scene, "solids_stress");
  if (const auto file = table_file(law)) return regime_of_table(*file) == core::BoxRegime::dry;
  return relevance::effects::solids_stress.law_has(law, relevance::effects::kinetic_theory);
}

std::string wrong_for_exchange(const core::Scene& scene, const std::string& file) {
  if (scene.species.size() != 2)
    return fmt::format("table:{} is of two species, the case has {}", file, scene.species.size());
  if (const core::BoxRegime regime = regime_of_table(file); regime != core::BoxRegime::dry)
    return fmt::format("table:{} is a {} table: what species exchange is measured in dry boxes alone", file,
                       core::name_of(regime));
  if (std::string wrong = wrong_regime(scene, file, core::BoxRegime::dry); !wrong.empty()) return wrong;
  if (read_solids_table(file).exchange.value.empty())
    return fmt::format("table:{} holds no beta_12: polybed calibrate measures it in dry boxes, with calibrate.share",
                       file);
  if (core::law_of(scene, "solids_stress") != core::automatic && !has_temperature(scene))
    return fmt::format("table:{} needs granular temperatures: solids_stress = \"kinetic\" or a dry table", file);
  return "";
}

template <class Judge>
std::string judged(const core::Scene& scene, const std::string& file, Judge&& judge) {
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    return fmt::format("table:{}: no such file in the working directory or beside the case file", file);
  if (is_left_open(scene)) return "";
  try {
    return judge(scene, file);
  } catch (const core::CaseError& error) {
    return error.what();
  } catch (const core::FileError&) {  // reported with its own exit code when the model is created
    return "";
  }
}

}  // namespace

std::string wrong_with_stress_table(const core::Scene& scene, const std::string& file) {
  return judged(scene, file, wrong_for_stress);
}

std::string wrong_with_exchange_table(const core::Scene& scene, const std::string& file) {
  return judged(scene, file, wrong_for_exchange);
}

}  // namespace polybed::tfm
