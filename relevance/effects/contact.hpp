// Forces of touching particles.
#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "relevance/effect.hpp"

namespace polybed::relevance::effects {

inline std::optional<EffectRow> weigh_contact(const Weighing& by, EffectRow row) {
  const core::Scene& scene = by.scene;
  const bool walls = scene.column.sides == core::Boundary::wall || scene.column.ends == core::Boundary::wall;
  row.value = std::max(by.survey.mean_fraction, by.survey.solids_fraction);
  row.threshold = 1e-3;
  row.state = EffectRow::State::on;  // the particle model has no other way to keep particles apart
  double friction = scene.material.friction;
  for (const core::Species& s : scene.species) friction = std::max(friction, s.friction);
  for (const core::ContactPair& p : scene.contact_pairs) friction = std::max(friction, p.friction.value_or(0));
  const bool rubs = friction > 0 && (*row.value > 0.3 || scene.column.sides == core::Boundary::wall);
  if (!rubs) row.model = "hertz";
  row.reason = fmt::format(
      "{}; {}", *row.value > 1e-3 ? "particles touch" : (walls ? "particles touch walls" : "never left out"),
      rubs ? "they rub, being dense or sheared by walls" : "they do not rub: neither dense nor sheared");
  return row;
}

inline constexpr Trait frictionless{"no friction, so that nothing rotates"};
inline constexpr Trait linear_springs{"by dem.normal_stiffness"};
inline constexpr Trait elastic_spheres{"by Young's modulus"};

inline const Effect contact{
    .role = "contact",
    .help = "forces of touching particles",
    .absent = "part of the solids stress in the two-fluid model",
    .laws = {{"hertz_mindlin", "Hertz's normal force and friction by dem.tangential",
              "Hertz 1882; Mindlin and Deresiewicz 1953"},
             {"hertz", "Hertz's normal force alone: no friction, no rotation", "Hertz 1882"},
             {"linear", "linear springs, dem.normal_stiffness", "Cundall and Strack 1979"}},
    .number = "solids fraction",
    .weigh = weigh_contact,
    .traits = {
        {&frictionless, {"hertz"}}, {&linear_springs, {"linear"}}, {&elastic_spheres, {"hertz_mindlin", "hertz"}}}};

}  // namespace polybed::relevance::effects
