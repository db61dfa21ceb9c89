// Results of a run for its bed, computed from its history, the same for both models.
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

/// Order of the species; layered: the less dense is above or, at equal density, the smaller. Unknown: only one species.
enum class Layers { unknown, mixed, layered, inverted };

/// Name in run.json; empty if unknown.
[[nodiscard]] std::string name_of(Layers layers);

/// Over the last quarter of the time that the history covers.
struct BedOfRun {
  double window = 0;                         ///< s
  bool hangs = false;                        ///< lighter than the fluid, and not pressed onto the bottom
  std::optional<measures::TimeMean> height;  ///< m; empty for a bed that hangs
  std::optional<measures::TimeMean> dense;   ///< m, top of the dense bed; likewise
  /// Heights, m, that species reach, in the order of the case; size classes count as one. Species of which 95 % have
  /// left the column are missing.
  std::vector<std::pair<std::string, measures::TimeMean>> tops;
  std::optional<measures::TimeMean> pressure;          ///< pressure drop, Pa
  std::optional<measures::TimeMean> drop;              ///< the same over the buoyant weight
  std::optional<double> mixing;                        ///< 1 mixed, 0 separated
  double cell = 0;                                     ///< m, height of a cell
  std::vector<std::pair<std::string, double>> masses;  ///< kg in the column at the end; size classes count as one
  Fluidisation state{};
  Layers layers{};
  std::map<std::string, double> out;       ///< kg since the start, by kind, for a scene with openings
  std::map<std::string, double> recovery;  ///< the same over the initial amount plus the feed
  /// One of several ways out of the column.
  struct Exit {
    std::string name;
    std::optional<measures::TimeMean> flow;  ///< of fluid and solids, m3/s
    std::map<std::string, double> out;       ///< kg since the start, by kind
  };
  std::vector<Exit> exits;
  /// Of a box with joined ends in a fluid: see measures/box_flow.hpp.
  struct Joined {
    std::vector<std::pair<std::string, measures::TimeMean>> slips;  ///< by kind, m/s
    std::optional<measures::TimeMean> superficial_slip;             ///< m/s
    double gradient = 0, mass_velocity = 0;                         ///< in the last row, Pa/m, m/s
  };
  std::optional<Joined> joined;
  std::optional<double> discharge;  ///< kg/s, from a hopper
  bool blocked = false;             ///< its opening is blocked
  std::optional<bool> steady;       ///< empty: too few rows
  std::vector<measures::DriftOfMeasure> drifts;
};

/// Results from the rows; entries are empty if a history lacks the columns, and all are for fewer than ten listed
/// particles. The bed is fluidised if the pressure drop is at least 95 % of the weight. It is carried out if less than
/// 1 % is left or, unless it hangs, if its centre is above three quarters of the column. Species are mixed if their
/// centres are closer than a tenth of the bed height. The discharge is the mean rate between a tenth and nine tenths of
/// the outflow, at least ten particles. A hopper is blocked if nothing has left it over the window and more than half
/// remains: it then has no discharge.
[[nodiscard]] BedOfRun bed_of_run(const core::Scene& scene, const core::History& history);

}  // namespace polybed::multiscale
