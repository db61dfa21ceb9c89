// The force of the fluid on every species or particle.
#pragma once

#include <fmt/format.h>

#include "closures/drag.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"

namespace polybed::relevance::effects {

inline constexpr const char* disagrees_in_mixtures =
    "in mixtures the drag on all species together differs from the pressure drop by the same law";

inline std::vector<core::Law> laws_of_drag() {
  std::vector<core::Law> laws;
  for (const closures::DragLawInfo& law : closures::drag_laws())
    laws.push_back({law.name, law.help, law.source, law.obeys_sum_rule ? "" : disagrees_in_mixtures});
  laws.push_back({"file:FILE", "a law file of polybed fit", "a form with its constants"});
  return laws;
}

inline std::optional<EffectRow> weigh_drag(const Weighing& by, EffectRow row) {
  if (!by.survey.has_fluid) return std::nullopt;
  const double tolerance = by.scene.chooser.tolerance;
  row.model = by.survey.drag_law;
  row.state = EffectRow::State::on;
  row.value = by.survey.mixture_part;
  row.threshold = tolerance;
  row.share_off = 1;
  row.reason = "always on";
  if (by.scene.species.size() > 1)
    row.reason += fmt::format("; the sizes are dragged up to {} apart from their mean: {}", percent(*row.value),
                              *row.value > tolerance ? "take a law for mixtures" : "any law will do");
  return row;
}

inline const Effect drag{.role = "drag",
                         .help = "force of the fluid on every species or particle",
                         .laws = laws_of_drag(),
                         .advice = {{"wen_yu", "fluidised bed; of several sizes with partition = \"brinkman_oseen\""},
                                    {"richardson_zaki", "the same, in a liquid that expands the bed evenly"},
                                    {"gidaspow", "bubbling gas bed"},
                                    {"brinkman_oseen", "fixed or packed bed, of one size or several"},
                                    {"cello", "liquid bed as in the thesis of Cello (2009), and in most shipped cases"},
                                    {"turton_levenspiel", "a single sphere"}},
                         .rules = {needs_a_fluid("drag")},
                         .number = "mixture part, max |f_j/f_mean - 1|",
                         .weigh = weigh_drag};

}  // namespace polybed::relevance::effects
