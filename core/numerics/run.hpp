// The loop over events, for any model: step, show what was passed on the way, stop where something happens.
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
  /// Makes the state at a time inside the last step (or now) the one that observers read.
  virtual void show(double t) = 0;
  /// Whether show() finds a state of its own for each time inside a step. Else outputs denser than the steps become
  /// those of the steps, at their times.
  [[nodiscard]] virtual bool shows_inside_steps() const { return true; }
  /// Handles an event at the present time: what jumps there jumps, and the integrator forgets its history, so
  /// that a run resumed here gives the same bits as one that went on.
  virtual void restart() = 0;
};

/// Something that acts on the state at multiples of a period, from the start on.
struct Observer {
  std::string name;
  double every = 0;  ///< s; 0: only at the start and at the end
  std::function<void(double time)> act;
};

/// What stops a step: checkpoints, where the run can be taken up again, and times at which the problem jumps.
struct Stops {
  double until = 0;                 ///< s, end of the run
  double checkpoint_every = 0;      ///< s; 0: only at the end
  std::vector<double> breakpoints;  ///< s
};

/// Runs a simulation from its present time to stops.until. Stops and output times that rounding alone keeps apart
/// (core/numerics/schedule.hpp) are one event: one step ends there, at the time of the breakpoint or else of the end.
/// Observers act at every multiple of their period after the present time, in the order given, and `at_start`
/// says whether they act on the state at the start too (not after a resume: they have). `checkpoint` is
/// called at checkpoint times and at the end; `after_step` after every accepted step and returns false if the
/// user wants to stop: then a checkpoint is written and Stopped is thrown. `stop_wanted` says the same before each
/// further output of a step that passes several: a step that passes a million does not keep the user waiting, and what
/// it leaves out is in the message.
void run(Simulation& simulation, const Stops& stops, const std::vector<Observer>& observers, bool at_start,
         const std::function<void(double)>& checkpoint, const std::function<bool()>& after_step,
         const std::function<bool()>& stop_wanted = {});

}  // namespace polybed::core
