// Distribution of a mean law's drag among species of different sizes.
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

/// Decided by the state of the spheres, fixed or suspended, and by whether the drag law can be distributed.
inline std::optional<EffectRow> weigh_partition(const Weighing& by, EffectRow row) {
  if (!by.survey.has_fluid || by.scene.species.size() < 2) return std::nullopt;
  const AdvisedDrag& drag = by.survey.drag;
  const AdvisedDrag advised = advised_drag(by.scene, by.survey.drag_scene);
  const bool shared = core::is_law(drag.partition), could = core::is_law(advised.partition) && is_mean_law(drag.law);
  row.model = shared ? drag.partition : advised.partition;
  row.choice = true;
  if (shared || (could && by.survey.mixture_part > by.scene.chooser.tolerance)) row.state = EffectRow::State::on;
  row.reason = by.survey.drag_scene == DragScene::fixed
                   ? "fixed: drag = \"brinkman_oseen\" alone is the most accurate for fixed spheres"
               : core::is_off(advised.partition) ? "the drag law acts on each species by itself"
                                                 : "suspended spheres of several sizes";
  return row;
}

/// Broken if the drag is not a law for one size.
inline core::Broken shares_no_mean(const core::Scene& scene) {
  const std::string drag = scene.drag().name, partition = scene.partition().name;
  if (!scene.partition().given || partition == core::automatic) return {};
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
                 [](const core::Scene& scene) { return !scene.drag().given; }),
         {{"effects.partition", "effects.drag"},
          "effects.partition = \"{}\" cannot share drag = \"{}\", which is a law of mixtures itself: give a law of "
          "one size, e.g. \"wen_yu\" or \"vbk\"",
          shares_no_mean}},
    .number = "fixed or fluidised, docs/guide/choose-a-drag-law.md",
    .weigh = weigh_partition};

}  // namespace polybed::relevance::effects
