// The time loop for any model: step, show the output times passed, stop at events.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace polybed::core {

/// A model that can be advanced in time.
class Simulation {
 public:
  virtual ~Simulation() = default;
  /// Time reached, s.
  [[nodiscard]] virtual double time() const = 0;
  /// Takes one accepted step, not beyond `stop`.
  virtual void step(double stop) = 0;
  /// Sets the state that observers read to a time inside the last step (or now).
  virtual void show(double t) = 0;
  /// Whether show() computes a state for each time inside a step. Otherwise outputs denser than the steps are taken at
  /// the steps.
  [[nodiscard]] virtual bool shows_inside_steps() const { return true; }
  /// Handles an event at the present time: applies jumps and clears the integrator's history, so that a run resumed
  /// here gives the same bits as one that continued.
  virtual void restart() = 0;
};

/// An action on the state at multiples of a period, beginning at the start.
struct Observer {
  std::string name;
  double every = 0;  ///< s; 0: only at the start and at the end
  std::function<void(double time)> act;
};

/// Times at which a step stops: checkpoints, where the run can be resumed, and times at which the problem jumps.
struct Stops {
  double until = 0;                 ///< s, end of the run
  double checkpoint_every = 0;      ///< s; 0: only at the end
  std::vector<double> breakpoints;  ///< s
};

/// Runs a simulation from its present time to stops.until. Stops and output times that differ only by rounding
/// (core/numerics/schedule.hpp) are one event: one step ends there, at the time of the breakpoint or else of the end.
/// Observers act at every multiple of their period after the present time, in the given order. `at_start` says whether
/// they also act on the state at the start (not after a resume). `checkpoint` is called at checkpoint times and at the
/// end. `after_step` is called after every accepted step and returns false if the user requests a stop: run() then
/// writes a checkpoint and throws Stopped. `stop_wanted` is checked before each further output of a step that passes
/// several, so that the user does not wait for a million outputs; the message names those left out.
void run(Simulation& simulation, const Stops& stops, const std::vector<Observer>& observers, bool at_start,
         const std::function<void(double)>& checkpoint, const std::function<bool()>& after_step,
         const std::function<bool()>& stop_wanted = {});

}  // namespace polybed::core
