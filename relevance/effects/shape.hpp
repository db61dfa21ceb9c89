// Non-spherical particles.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "relevance/drag_law.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/supremum.hpp"

namespace polybed::relevance::effects {

inline std::vector<core::Law> laws_of_shape() {
  std::vector<core::Law> laws;
  for (const closures::ShapeLaw& law : closures::shape_laws)
    laws.push_back({std::string(law.name), std::string(law.help), std::string(law.source)});
  return laws;
}

/// On if a species is not spherical: the case says so, and the factor costs nothing.
inline std::optional<EffectRow> weigh_shape(const Weighing& by, EffectRow row) {
  if (!by.survey.has_fluid) return std::nullopt;
  row.threshold = by.scene.chooser.tolerance;
  row.neglected = 0;
  row.reason = "every species is a sphere";
  if (core::all_spheres(by.scene)) return row;
  core::Scene with = by.scene;
  if (core::is_law(core::law_of(with, "shape"))) row.model = core::law_of(with, "shape");
  with.effects["shape"] = row.model;
  Supremum greatest;
  for (const Situation& s : by.survey.situations)
    for (const core::Species& species : with.species)
      if (species.name == s.species) greatest.add(s, std::abs(shape_of(with, species)(s.voidage, s.reynolds()) - 1));
  greatest.fill(row);
  row.neglected.reset();
  row.share_off = row.value;
  row.state = EffectRow::State::on;
  const auto least = std::min_element(with.species.begin(), with.species.end(),
                                      [](const auto& a, const auto& b) { return a.sphericity < b.sphericity; });
  row.reason = fmt::format("{} has a sphericity of {:g}: its drag differs by up to {} from that of spheres",
                           least->name, least->sphericity, percent(row.value.value_or(0)));
  return row;
}

inline const Effect shape{
    .role = "shape",
    .help = "factor on any drag law for non-spherical particles, by species.sphericity",
    .laws = laws_of_shape(),
    .advice = {{"ergun", "the default where species.sphericity is below 1: beds of a voidage below 0.8"},
               {"ganser", "particles far apart, which rise or settle alone"}},
    .rules = {needs_a_fluid("shape"),
              rule_of("shape", {"species.sphericity"},
                      "effects.shape = \"{}\" changes nothing: every species is a sphere; give species.sphericity "
                      "below 1, or leave out effects.shape",
                      [](const core::Scene& scene) { return core::all_spheres(scene); }),
              rule_of("shape", {"effects.drag"}, "effects.shape = \"{}\" is a factor on the drag: give effects.drag",
                      [](const core::Scene& scene) { return !scene.drag().acts(); })},
    .number = "max |drag at the sphericity/drag of spheres - 1|",
    .phrase = "the shape changes the drag by {} its value",
    .weigh = weigh_shape};

}  // namespace polybed::relevance::effects
