// The drag law of a case: its mean law, and the partition if it names one.
#pragma once

#include "closures/drag.hpp"
#include "core/case/scene.hpp"

namespace polybed::relevance {

/// Throws std::invalid_argument where the case has no law, or a partition of what is no law of one size.
[[nodiscard]] inline closures::DragLaw drag_law_of(const core::Scene& scene) {
  return closures::drag_law(core::law_of(scene, "drag"), core::law_of(scene, "partition"), closures::Guard::on);
}

/// Its name for reports: "wen_yu", or "wen_yu x brinkman_oseen".
[[nodiscard]] inline std::string drag_name_of(const core::Scene& scene) {
  const auto partition = scene.effects.find("partition");
  return core::law_of(scene, "drag") + (partition == scene.effects.end() ? "" : " x " + partition->second);
}

}  // namespace polybed::relevance
