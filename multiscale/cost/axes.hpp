// What a sweep varies: axes, their levels, and the settings of the command line that a level stands for.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::multiscale {

enum class AxisKind { numerics, statistics, model, machine };

struct Level {
  std::string label;                   ///< e.g. "1e-3", "18x128"
  double value = 0;                    ///< in the direction of the axis; 0: it has none
  std::vector<std::string> overrides;  ///< key=value each
  std::string model;                   ///< tfm | dem | force_balance; empty: that of the sweep
  int ranks = 1;
};

struct Axis {
  std::string name;
  AxisKind kind = AxisKind::numerics;
  std::vector<Level> levels;  ///< from cheap to dear where that is known
  std::size_t given = 0;      ///< the level of the case as it is
  std::vector<Level> beyond;  ///< dearer ones, for the reference
};

/// Level of each axis by its number; an axis left out has the given one.
using Settings = std::map<std::string, std::size_t>;

/// The axes of these names that act in a model, in that order; throws core::CaseError for an unknown name.
/// \param model  tfm | dem   \param names  empty: those a sweep has by default
[[nodiscard]] std::vector<Axis> axes_of(const core::Scene& scene, const std::string& model,
                                        const std::vector<std::string>& names);

/// The case on cells divided by a factor (2: twice as coarse); no axis has fewer than one.
[[nodiscard]] Level grid_level(const core::Scene& scene, double coarser);

/// Names of the axes that act in this case by a model.
[[nodiscard]] std::vector<std::string> acting_axes(const core::Scene& scene, const std::string& model);

/// All names, for messages.
[[nodiscard]] std::vector<std::string> axis_names();

}  // namespace polybed::multiscale
