// Moments that resist rolling.
#pragma once

#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"

namespace polybed::relevance::effects {

inline std::optional<EffectRow> weigh_rolling(const Weighing& by, EffectRow row) {
  const bool heap = by.scene.chooser.static_heap;
  row.model = "epsd";
  row.state = heap ? EffectRow::State::on : EffectRow::State::off;
  row.reason = heap ? "a heap at rest needs resistance to rolling: dem.rolling_friction"
                    : "only a heap at rest needs it: chooser.static_heap";
  if (!heap) row.neglected = 0;
  return row;
}

/// The law whose contacts come to rest.
inline constexpr const char* with_spring = "epsd";
inline constexpr Trait without_spring{"a constant moment, which has nothing to damp"};

inline const Effect rolling{
    .role = "rolling",
    .help = "moments that resist rolling, dem.rolling_friction",
    .absent = "part of the solids stress in the two-fluid model",
    .laws = {{"cdt", "constant moment against the rolling, for contacts that move", "mu_r R* F_n; Ai et al. 2011, A"},
             {"epsd", "spring of rotation with a greatest moment, for heaps at rest, dem.rolling_damping",
              "Ai et al. 2011, C"}},
    .rules = excludes("rolling", any_law, "contact", "hertz",
                      "a resistance to rotation, and nothing rotates without friction"),
    .number = "chooser.static_heap",
    .weigh = weigh_rolling,
    .traits = {{&without_spring, {"cdt"}}}};

}  // namespace polybed::relevance::effects
