// What a hard case is run with: a scene, a treatment of it, the invariants that are watched, and what came of it.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "tfm/model.hpp"

namespace polybed::hard {

/// How a scene is treated: a scheme of the product, or a textbook variant of tests/naive by name.
struct Treatment {
  std::string integrator = "explicit", flux = "limited", naive;
  [[nodiscard]] std::string name() const {
    if (!naive.empty()) return "naive " + naive;
    return flux.empty() ? integrator : integrator + "/" + flux;
  }
};

/// One run of a scene, by the product's model or by a naive variant that shares its fields.
class Run {
 public:
  virtual ~Run() = default;
  [[nodiscard]] virtual double time() const = 0;
  /// One accepted step, not beyond `stop`.
  virtual tfm::StepLine step(double stop) = 0;
  /// Fields of the present state.
  virtual const tfm::Fields& fields() = 0;
  /// Handles a jump of the inlet.
  virtual void restart() = 0;
  [[nodiscard]] virtual tfm::Work work() const = 0;
  /// The product's model of the scene: constants, effects, scales.
  [[nodiscard]] virtual tfm::Model& model() = 0;
};

/// A figure against its limit.
struct Measured {
  std::string id;
  double value = 0, limit = 1;
  [[nodiscard]] double share() const { return limit > 0 ? value / limit : value > 0 ? 1e300 : 0; }
};

/// pass: all figures within their limits; degraded: within ten times; refused: stopped with a reason, the last state
/// sound; fail: anything else.
enum class Outcome { pass, degraded, refused, fail };
[[nodiscard]] std::string name_of(Outcome outcome);

struct Result {
  Outcome outcome = Outcome::pass;
  Measured worst;
  double least_step = 0;  ///< s; of steps that neither an event cut nor a start began
  tfm::Work work;
  double cpu = 0;  ///< s
  std::string cause;
  std::string broken;    ///< the invariants beyond their limits
  std::string reported;  ///< further figures, without a limit
};

/// What is watched in a run beside mass, bounds, finiteness, drag power and steps.
struct Watch {
  bool settles = false;       ///< at the end, packed solids and flux below ten times the tolerance of velocities
  bool rests = false;         ///< V6 at the end: solids and flux below 1e-10 m/s
  bool rests_always = false;  ///< V6 at all times
  bool fluidised = false;  ///< V7: over the last half, pressure drop and solids pressure on the distributor carry the
                           ///< buoyant weight within 1e-3
  bool steps = true;       ///< V8: share of rejected steps, least step
  double cpu = 1e300;      ///< s of computing, after which the run ends where it is; below it also where it fails
  bool packing = true;     ///< V2's upper bound: phi_max + 1e-3 where a solids stress acts
};

/// One treatment of one case: runs scenes, keeps the worst of every invariant.
class Trial {
 public:
  explicit Trial(Treatment treatment) : treatment_(std::move(treatment)) {}

  [[nodiscard]] const Treatment& treatment() const { return treatment_; }
  [[nodiscard]] bool naive() const { return !treatment_.naive.empty(); }

  /// The scene as a run of the treatment, at its start; a state other than the scene's may be given to `start`, which
  /// changes the first field (the fractions, species by species, cell by cell).
  std::unique_ptr<Run> begin(core::Scene scene, const std::function<void(tfm::Model&)>& start = {});
  /// Advances to a time, stopping at the breakpoints of the inlet, and watches.
  void advance(Run& run, double until, const Watch& watch = {});
  /// Of a run that someone else drives: one step, watched now and then; a jump; the end.
  tfm::StepLine step(Run& run, double stop, const Watch& watch);
  void restart(Run& run);
  void see_end(Run& run, const Watch& watch, double mean_balance = 0);
  /// Keeps a figure of the case itself.
  void measure(const std::string& id, double value, double limit);
  /// Keeps what a run of the case's own took: steps, and the least of them, s.
  void keep_work(std::uint64_t steps, double least_step);
  /// Keeps a figure that has no limit, for the report.
  void report(const std::string& name, double value);
  /// Whether a figure is so far beyond its limit that the trial has failed, whatever comes.
  [[nodiscard]] bool has_failed() const;
  /// The outcome of `work`, exceptions and all.
  Result judge(const std::function<void(Trial&)>& work);

 private:
  void see(Run& run, const Watch& watch);
  void keep_step(Run& run, const tfm::StepLine& line, const Watch& watch);

  Treatment treatment_;
  core::Timers timers_;
  std::vector<double> initial_volume_;
  std::vector<Measured> worst_;
  double rtol_ = 1e-4, least_step_ = 0;
  double shortest_time_ = std::numeric_limits<double>::infinity();
  int steps_since_start_ = 0, small_steps_ = 0, steps_ = 0;
  tfm::Work work_;
  std::string reported_;
};

/// One case of the catalogue.
struct HardCase {
  std::string id, title;
  std::vector<std::string> naive;  ///< variants that must fail; none: a regression, not counted as hard
  std::vector<Treatment> schemes;  ///< of the product
  std::function<void(Trial&)> work;
  bool ci = true;  ///< among those that every change must pass
};

/// explicit/limited, explicit/upwind, implicit/limited.
[[nodiscard]] std::vector<Treatment> all_schemes();

/// All of them, in the order of the report.
[[nodiscard]] std::vector<HardCase> catalogue();

}  // namespace polybed::hard
