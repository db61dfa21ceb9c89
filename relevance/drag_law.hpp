// The drag law of a case: its mean law, and its partition if it names one. A law comes from the menu, or is a fitted or
// modified law in a file: "file:LAW.json".
#pragma once

#include <optional>

#include "closures/drag.hpp"
#include "core/case/scene.hpp"

namespace polybed::relevance {

/// The file that contains a law; nothing for a law in the menu.
[[nodiscard]] std::optional<std::string> drag_file(const std::string& law);

/// A law by its name in a case or a command. Throws std::invalid_argument for an unknown law or partition, and for a
/// partition of a law that is not for one size; core::CaseError with file, line and column for problems in a law file,
/// core::FileError if it cannot be read.
/// \param law  in the menu, or "file:LAW.json"  \param partition  "none": the law alone
[[nodiscard]] closures::DragLaw drag_law_named(const std::string& law, const std::string& partition = "none",
                                               closures::Guard guard = closures::Guard::on);

/// The law on particles of the shapes that a case gives its species, where it has effects.shape.
[[nodiscard]] closures::DragLaw with_shape(closures::DragLaw law, const core::Scene& scene);

/// The formulas of the shape that a case with particles other than spheres does not use.
[[nodiscard]] std::vector<std::string> other_shapes(const core::Scene& scene);

/// The factor of the shape of a species on drag; 1 without effects.shape.
[[nodiscard]] closures::ShapeFactor shape_of(const core::Scene& scene, const core::Species& species);

/// The drag law of a case, with its shapes. Throws std::invalid_argument also where the case has no law.
[[nodiscard]] inline closures::DragLaw drag_law_of(const core::Scene& scene) {
  return with_shape(drag_law_named(scene.drag().name, scene.partition().name), scene);
}

/// Its name for reports: "wen_yu", or "wen_yu x brinkman_oseen x ganser".
[[nodiscard]] inline std::string drag_name_of(const core::Scene& scene) {
  std::string name = scene.drag().name;
  for (const char* part : {"partition", "shape"})
    if (const auto law = scene.effects.find(part); law != scene.effects.end()) name += " x " + law->second;
  return name;
}

}  // namespace polybed::relevance
