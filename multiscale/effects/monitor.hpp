// Watches, during a run, what its scene has left out: a sample of its particles or cells every so many steps. A run
// that does not ask for it has no such object.
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

/// Whether a particle or cell is in the sample: one in `sample`, by a hash of its number, so that any number of ranks
/// looks at the same ones.
[[nodiscard]] bool in_sample(std::int64_t number, int sample);

class Monitor {
 public:
  /// Null if the scene asks for none, has no fluid, or is a sheared box, whose flow is given.
  [[nodiscard]] static std::unique_ptr<Monitor> of(const core::Scene& scene, const std::string& model);
  Monitor(const core::Scene& scene, const std::string& model);

  /// After each step: whether this one is looked at.
  [[nodiscard]] bool due() { return ++steps_ % scene_.chooser.monitor_every == 0; }

  /// Looks at the state. Collective. Returns what there is to say for the first time; throws NumericsError with
  /// monitor = "stop".
  [[nodiscard]] std::vector<std::string> look(const dem::Model& model);
  [[nodiscard]] std::vector<std::string> look(const tfm::Model& model);

  /// Of all ranks. Collective.
  [[nodiscard]] Neglected result(const core::Ranks* ranks) const;
  /// For a checkpoint. Collective.
  [[nodiscard]] core::Json past(const core::Ranks* ranks) const;
  /// Takes up what the run that this one goes on with has seen and warned of; of other forces, where the run leaves out
  /// others now, only the warnings.
  void recall(const core::Json& past, const core::Ranks* ranks);
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
  /// Whether it has ended the run.
  [[nodiscard]] bool has_stopped() const { return stopped_; }
  /// Of what was warned of, in words of --set: the laws that a run can take up from its checkpoint, forces that keep
  /// nothing of the past. Of the sum that which has most of it.
  [[nodiscard]] const std::vector<std::string>& settings() const { return settings_; }

 private:
  [[nodiscard]] std::vector<std::string> judge(const core::Ranks* ranks, double time);
  void find_setting(const Observed& exceeded);

  core::Scene scene_;
  Neglected seen_, latest_;  ///< of the whole run, and of the sample at hand
  Neglected empty_;
  std::vector<int> samples_above_;
  std::vector<double> since_;
  std::vector<std::string> warnings_, settings_;
  std::string model_;
  std::int64_t steps_ = 0;
  bool stopped_ = false;
};

}  // namespace polybed::multiscale
