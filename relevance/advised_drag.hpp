// Which drag law a scene calls for, and whether the law that it names suits it: docs/guide/choose-a-drag-law.md.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::relevance {

struct Survey;

/// What is dragged.
enum class DragScene {
  lone,        ///< spheres far from each other
  fixed,       ///< held, or packed and never lifted
  gas_bed,     ///< suspended in a gas
  liquid_bed,  ///< suspended in a liquid, which expands them evenly
};

/// \param survey  with the fluid's properties and the bed as it starts
[[nodiscard]] DragScene drag_scene_of(const core::Scene& scene, const Survey& survey);

/// The law to take, and its partition: "none" if it needs no other.
struct AdvisedDrag {
  std::string law, partition = "none";
};
[[nodiscard]] AdvisedDrag advised_drag(const core::Scene& scene, DragScene kind);

/// Laws that were made from beds of a kind, to compare the law of a case with; none of lone and of fixed spheres.
[[nodiscard]] std::vector<std::string> laws_of_beds(DragScene kind);

/// Why a law does not suit; empty if it does, or if nothing is known of it, as of a fitted one.
[[nodiscard]] std::string unsuited(const std::string& law, DragScene kind);

/// Whether a law knows of one sphere alone: in a bed it is wrong, not merely less accurate than others.
[[nodiscard]] bool ignores_neighbours(const std::string& law);

/// Whether a partition can share a law: one of a single size that acts on each species by itself.
[[nodiscard]] bool is_mean_law(const std::string& law);

/// The laws that a run takes: those that the scene names, in place of "auto" the advised ones, and "none" for what a
/// law of mixtures does itself. Without a drag that acts they are the advised ones, by which forces are balanced.
[[nodiscard]] AdvisedDrag drag_taken(const core::Scene& scene, const Survey& survey);

}  // namespace polybed::relevance
