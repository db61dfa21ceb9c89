// What a run has made of a bed: read off its history, the same for both models.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/output/history.hpp"
#include "measures/drift.hpp"
#include "measures/window.hpp"
#include "multiscale/card/bed_of_case.hpp"

namespace polybed::multiscale {

/// Which species is above; layered: the less dense or, of equal density, the smaller. Unknown: there is one species.
enum class Layers { unknown, mixed, layered, inverted };

/// As run.json has it; empty if unknown.
[[nodiscard]] std::string name_of(Layers layers);

/// Over the last quarter of the time that the history covers.
struct BedOfRun {
  double window = 0;                         ///< s
  bool hangs = false;                        ///< lighter than the fluid, and not pressed onto the bottom
  std::optional<measures::TimeMean> height;  ///< m; of a bed that hangs nothing
  std::optional<measures::TimeMean> dense;   ///< m, top of the dense bed; likewise
  /// Heights, m, that species reach, in the order of the case: size classes count as one. Those of which 95 % have left
  /// the column are missing.
  std::vector<std::pair<std::string, measures::TimeMean>> tops;
  std::optional<measures::TimeMean> pressure;  ///< pressure drop, Pa
  std::optional<measures::TimeMean> drop;      ///< the same over the buoyant weight
  std::optional<double> mixing;                ///< 1 mixed, 0 separated
  Fluidisation state{};
  Layers layers{};
  std::map<std::string, double> out;       ///< kg since the start, of a scene that lets particles out, by kinds
  std::map<std::string, double> recovery;  ///< the same over what was there at the start and was fed
  std::optional<double> discharge;         ///< kg/s, of a hopper
  bool blocked = false;                    ///< its opening is
  std::optional<bool> steady;              ///< empty: too few rows
  std::vector<measures::DriftOfMeasure> drifts;
};

/// What the rows say; entries that a history lacks are empty, and all of fewer than ten listed particles.
/// Packed and fluidised are told apart by the pressure drop, 95 % of the weight; carried out is a bed of which less
/// than 1 % is left, or, if it does not hang, whose centre is above three quarters of the column. Mixed are centres
/// closer than a tenth of the bed height. The discharge is the mean rate between a tenth and nine tenths of what has
/// left, at least ten particles. A hopper is blocked when nothing has left it over the window and more than half
/// remains: then it has no discharge.
[[nodiscard]] BedOfRun bed_of_run(const core::Scene& scene, const core::History& history);

}  // namespace polybed::multiscale
