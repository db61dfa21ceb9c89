// How the drag of a mean law is shared among species of different sizes.
#pragma once

#include <algorithm>

#include "closures/drag.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/effects/drag.hpp"

namespace polybed::relevance::effects {

inline std::vector<core::Law> laws_of_partition() {
  std::vector<core::Law> laws;
  for (const closures::DragLawInfo& law : closures::partitions())
    laws.push_back({law.name, law.help, law.source, law.obeys_sum_rule ? "" : disagrees_in_mixtures});
  return laws;
}

/// Never chosen: whether spheres are fixed or suspended decides, which no number of a single particle does.
inline std::optional<EffectRow> weigh_partition(const Weighing& by, EffectRow row) {
  if (!by.survey.has_fluid || by.scene.species.size() < 2) return std::nullopt;
  row.model = core::law_of(by.scene, "partition");
  const auto expanded = [&](const Situation& s) {  // more open than the settled bed, and no lone particle
    return s.voidage < 1 && s.voidage > 1 - by.scene.bed.solids_fraction + 1e-9;
  };
  const auto& all = by.survey.situations;
  const bool expands = !by.scene.bed.held && std::any_of(all.begin(), all.end(), expanded);
  row.reason = expands ? "fluidised: suspended spheres drag less than fixed ones, so take a mean law of expanded beds, "
                         "drag = \"richardson_zaki\" or \"wen_yu\", with partition = \"brinkman_oseen\""
                       : "fixed: drag = \"brinkman_oseen\" alone is the most accurate for fixed spheres";
  return row;
}

/// Broken by a drag that is no law of one size.
inline core::Broken shares_no_mean(const core::Scene& scene) {
  const std::string drag = core::law_of(scene, "drag"), partition = core::law_of(scene, "partition");
  if (!scene.effects.contains("partition") || partition == core::automatic) return {};
  for (const closures::DragLawInfo& law : closures::drag_laws())
    if (law.name == drag && !law.is_mean) return core::Broken({partition, drag});
  return {};
}

inline const Effect partition{
    .role = "partition",
    .help = "how a drag law of one size is shared among species; left out: as the drag law does itself",
    .laws = laws_of_partition(),
    .advice = {{"brinkman_oseen", "fluidised bed of several sizes, with drag = \"wen_yu\" or \"richardson_zaki\""},
               {"cello", "where the pressure drop must be exactly that of the mean law"}},
    .rules =
        {needs_a_fluid("partition"),
         rule_of("partition", {"effects.drag"},
                 "effects.partition = \"{}\" shares a drag law of one size: give effects.drag, e.g. \"wen_yu\"",
                 [](const core::Scene& scene) { return !scene.effects.contains("drag"); }),
         {{"effects.partition", "effects.drag"},
          "effects.partition = \"{}\" cannot share drag = \"{}\", which is a law of mixtures itself: give a law of "
          "one size, e.g. \"wen_yu\" or \"vbk\"",
          shares_no_mean}},
    .number = "fixed or fluidised, docs/guide/choose-a-drag-law.md",
    .weigh = weigh_partition};

}  // namespace polybed::relevance::effects
