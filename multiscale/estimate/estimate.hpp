// Cost of a run, before it: time with a band, memory, disk, the limit of the step, and ways to reduce the cost.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/output/json.hpp"
#include "multiscale/estimate/machine.hpp"

namespace polybed::tfm {
class Model;  // a run of particles does not include it
}

namespace polybed::multiscale {

struct Requirements;

/// CPU seconds that cover 90 of 100 runs, and their middle.
struct TimeBand {
  double least = 0, expected = 0, most = 0;
  double start = 0;  ///< part of expected before the first step, known within a factor of 2

  /// The band for a part of the run. \param share  of its simulated time  \param from_start  include the start
  [[nodiscard]] TimeBand part(double share, bool from_start) const;
};

/// A way to make a run cheaper, and its loss.
struct Way {
  std::string change;    ///< e.g. "relative tolerance tfm.rtol = 0.01"
  double time = 0.5;     ///< share of the run's time
  std::string loss;      ///< in words
  std::string evidence;  ///< measured | extrapolated | literature
};

struct CostEstimate {
  std::string model;  ///< tfm | dem
  int ranks = 1;
  TimeBand time;               ///< of all ranks together
  double wall = 0;             ///< s
  std::string basis;           ///< basis of the time
  double steps = 0, step = 0;  ///< number and mean, s
  std::string limited_by;
  double memory = 0, disk = 0;  ///< bytes
  std::vector<Way> ways;
};

/// A run of the two-fluid model from an existing model: from the time scales of its bed and the cost of a step. Takes
/// no step.
[[nodiscard]] TimeBand tfm_time(const core::Scene& scene, const tfm::Model& model, const Machine& machine);

/// The same with the cost of a step measured on the run itself, CPU s.
[[nodiscard]] TimeBand tfm_time(const core::Scene& scene, const tfm::Model& model, const Machine& machine,
                                double seconds_per_step);

/// The same with the cost of a step measured on a part of the bed. \param need  with its time
[[nodiscard]] TimeBand tfm_time(const core::Scene& scene, const Requirements& need, const Machine& machine);

/// A run of particles, likewise.
[[nodiscard]] TimeBand dem_time(const core::Scene& scene, const Machine& machine);

/// The complete estimate. The cost of a step of the two-fluid model is measured on a narrow part of the bed for a
/// quarter of a second; with a probe both models run the case itself for that long and extrapolate.
/// \param probe  CPU seconds; 0: none   \param ranks  that will share the case
[[nodiscard]] CostEstimate estimate_tfm(const core::Scene& scene, const Machine& machine, double probe, int ranks);
[[nodiscard]] CostEstimate estimate_dem(const core::Scene& scene, const Machine& machine, double probe, int ranks);

/// {"expected_s", "least_s", "most_s"}.
[[nodiscard]] core::Json seconds_of(const TimeBand& time);

/// Members of an object that is open.
void write_estimate(core::Json& json, const CostEstimate& estimate);
void print_estimate(const core::Scene& scene, const CostEstimate& estimate);

/// The prediction made before the run, for run.json. \param predicted  for the time simulated since
/// \param ended  else the actual time is left out  \param actual  CPU s
void write_prediction(core::Json& json, const TimeBand& predicted, bool ended, double actual);

/// Three applicable ways, those with the least loss first.
[[nodiscard]] std::vector<Way> tfm_ways(const core::Scene& scene, bool implicit, int ranks, int cores);
[[nodiscard]] std::vector<Way> dem_ways(const core::Scene& scene, const std::string& limited_by, int ranks, int cores);

}  // namespace polybed::multiscale
