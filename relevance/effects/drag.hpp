// The force of the fluid on every species or particle.
#pragma once

#include <fmt/format.h>

#include <vector>

#include "closures/bed_expansion.hpp"
#include "closures/drag.hpp"
#include "closures/mixture.hpp"
#include "closures/terminal_velocity.hpp"
#include "relevance/drag_law.hpp"
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

/// The velocity that lifts the settled bed with this law, and the particles' fall speed; empty if nothing settles.
inline std::string lifting_text(const Weighing& by) {
  const Survey& s = by.survey;
  std::vector<double> diameter;
  double excess = -s.fluid_density;
  for (std::size_t j = 0; j < by.scene.species.size(); ++j) {
    diameter.push_back(by.scene.species[j].diameter);
    excess += s.share[j] * by.scene.species[j].density;
  }
  const double mean = closures::sauter_diameter(s.share, diameter), gravity = by.scene.column.gravity;
  if (!(excess * gravity > 0 && by.scene.bed.solids_fraction > 0)) return "";
  const closures::DragLaw law = with_shape(drag_law_named(s.drag.law, s.drag.partition), by.scene);
  const auto f = [&](double eps, double re) { return closures::pure_drag_at(law, eps, re); };
  const double lifts = closures::carrying_velocity(f, {mean, excess, s.fluid_density, s.viscosity, gravity},
                                                   1 - by.scene.bed.solids_fraction),
               falls = closures::settling_velocity(mean, excess, s.fluid_density, s.viscosity, gravity,
                                                   law.shape ? law.shape->mean : closures::ShapeFactor());
  return fmt::format("; by it the bed is lifted at {:.3g} mm/s, {}a particle falls at {:.3g} mm/s", 1e3 * lifts,
                     lifts > falls ? "though " : "and ", 1e3 * falls);
}

inline std::optional<EffectRow> weigh_drag(const Weighing& by, EffectRow row) {
  const Survey& survey = by.survey;
  if (!survey.has_fluid) return std::nullopt;
  const double tolerance = by.scene.chooser.tolerance;
  row.model = survey.drag.law;
  row.state = EffectRow::State::on;
  row.value = survey.mixture_part;
  row.threshold = tolerance;
  row.share_off = 1;
  row.reason = "always on";
  if (const std::string why = unsuited(survey.drag.law, survey.drag_scene); !why.empty()) {
    const AdvisedDrag advised = advised_drag(by.scene, survey.drag_scene);
    row.model = advised.law;
    row.reason = why + (ignores_neighbours(survey.drag.law) ? lifting_text(by) : "");
    if (core::is_law(advised.partition) && !is_mean_law(survey.drag.law))
      row.reason += fmt::format("; with partition = \"{}\"", advised.partition);
  } else if (by.scene.species.size() > 1 && core::is_off(survey.drag.partition)) {
    row.reason += fmt::format("; the sizes are dragged up to {} apart from their mean: {}", percent(*row.value),
                              *row.value > tolerance ? "take a law for mixtures" : "any law will do");
  }
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
