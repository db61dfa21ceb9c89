// Monitors neglected effects during a run, in a sample of its particles or cells at intervals. A run without a monitor
// has no such object.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "multiscale/effects/neglected.hpp"

namespace polybed::dem {
class Model;
}
namespace polybed::tfm {
class Model;
}

namespace polybed::multiscale {

/// Whether a particle or cell is in the sample: one in `sample`, by a hash of its number, so that the sample is the
/// same on any number of ranks.
[[nodiscard]] bool in_sample(std::int64_t number, int sample);

class Monitor {
 public:
  /// Null if the scene has no monitor, has no fluid, or is a sheared box, whose flow is given.
  [[nodiscard]] static std::unique_ptr<Monitor> of(const core::Scene& scene, const std::string& model);
  Monitor(const core::Scene& scene, const std::string& model);

  /// Call it after each step: returns whether the sample is due.
  [[nodiscard]] bool due() { return ++steps_ % scene_.chooser.monitor_every == 0; }

  /// Evaluates the state. Collective. Returns messages that are new; throws NumericsError with monitor = "stop".
  [[nodiscard]] std::vector<std::string> look(const dem::Model& model);
  [[nodiscard]] std::vector<std::string> look(const tfm::Model& model);

  /// Over all ranks. Collective.
  [[nodiscard]] Neglected result(const core::Ranks* ranks) const;
  /// For a checkpoint. Collective.
  [[nodiscard]] core::Json past(const core::Ranks* ranks) const;
  /// Restores the observations and warnings of the run that this one continues; only the warnings if the run now
  /// neglects other forces.
  void recall(const core::Json& past, const core::Ranks* ranks);
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
  /// Whether it has stopped the run.
  [[nodiscard]] bool has_stopped() const { return stopped_; }
  /// Settings for the warnings, as words for --set: laws that a run can add from its checkpoint, for forces without
  /// memory of the past. For the sum, the law with the largest part.
  [[nodiscard]] const std::vector<std::string>& settings() const { return settings_; }

 private:
  [[nodiscard]] std::vector<std::string> judge(const core::Ranks* ranks, double time);
  void find_setting(const Observed& exceeded);

  core::Scene scene_;
  Neglected seen_, latest_;  ///< for the whole run, and for the present sample
  Neglected empty_;
  std::vector<int> samples_above_;
  std::vector<double> since_;
  std::vector<std::string> warnings_, settings_;
  std::string model_;
  std::int64_t steps_ = 0;
  bool stopped_ = false;
};

}  // namespace polybed::multiscale
