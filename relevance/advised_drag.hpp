// Drag laws that suit a scene, and whether the law of a case does: docs/guide/choose-a-drag-law.md.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::relevance {

struct Survey;

/// The state of the spheres that feel drag.
enum class DragScene {
  lone,        ///< spheres far from each other
  fixed,       ///< fixed in space, or packed and never lifted
  gas_bed,     ///< suspended in a gas
  liquid_bed,  ///< suspended in a liquid, which expands them evenly
};

/// \param survey  contains the fluid's properties and the bed at the start
[[nodiscard]] DragScene drag_scene_of(const core::Scene& scene, const Survey& survey);

/// The recommended law and partition; the partition is "none" if the law needs none.
struct AdvisedDrag {
  std::string law, partition = "none";
};
[[nodiscard]] AdvisedDrag advised_drag(const core::Scene& scene, DragScene kind);

/// Laws derived from beds of a kind, for comparison with the law of a case; empty for lone and fixed spheres.
[[nodiscard]] std::vector<std::string> laws_of_beds(DragScene kind);

/// Whether a law is there to compare others with: its drags on the species do not add up to that of the bed.
[[nodiscard]] bool serves_comparison(const std::string& law);

/// Why a law does not suit; empty if it does, or if nothing is known about it, as about a fitted law.
[[nodiscard]] std::string unsuited(const std::string& law, DragScene kind);

/// Whether a law is valid only for a lone sphere: in a bed it is wrong, not just less accurate than others.
[[nodiscard]] bool ignores_neighbours(const std::string& law);

/// Whether a partition can distribute a law: it must be for one size and act on each species separately.
[[nodiscard]] bool is_mean_law(const std::string& law);

/// The laws of a run: those that the scene names, the recommended ones for "auto", and "none" for a partition that a
/// mixture law replaces. If no drag acts, the recommended laws are used to balance forces.
[[nodiscard]] AdvisedDrag drag_taken(const core::Scene& scene, const Survey& survey);

}  // namespace polybed::relevance
