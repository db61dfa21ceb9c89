#include "core/numerics/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "core/numerics/schedule.hpp"

namespace polybed::core {

namespace {

/// The time that the next step must not pass.
struct Event {
  double time;      ///< s
  bool checkpoint;  ///< the run can be resumed there
};

/// The next event after a time. Breakpoints and checkpoints that are the same event are met together, at the
/// breakpoint's own time or, without one, at the end's.
Event next_event(const Stops& stops, double now) {
  const double checkpoint = next_multiple(stops.checkpoint_every, now);
  double breakpoint = std::numeric_limits<double>::infinity();
  for (const double t : stops.breakpoints)
    if (is_later(t, now)) breakpoint = std::min(breakpoint, t);
  const double first = std::min({stops.until, checkpoint, breakpoint});
  const double time = same_time(breakpoint, first) ? breakpoint : same_time(stops.until, first) ? stops.until : first;
  return {time, same_time(time, checkpoint) || same_time(time, stops.until)};
}

/// The observers of a run, and the time of each one's last action.
class Outputs {
 public:
  Outputs(Simulation& simulation, const std::vector<Observer>& observers, const std::function<bool()>& stop_wanted)
      : simulation_(simulation),
        observers_(observers),
        stop_wanted_(stop_wanted),
        acted_(observers.size(), -std::numeric_limits<double>::infinity()) {}

  void at_start(double t) {
    for (std::size_t n = 0; n < observers_.size(); ++n) act(n, t);
  }

  /// Runs all observers due in a step, until the user requests a stop. \param last  the run ends with it
  void of_step(double before, double now, bool last) {
    bool first = true;
    for (std::size_t n = 0; n < observers_.size(); ++n) {
      const double every = observers_[n].every;
      if (every > 0 && is_later(now - before, every) && !simulation_.shows_inside_steps()) {
        act(n, now);
        continue;
      }
      for (double due = next_multiple(every, before); !left_out_ && !is_later(due, now);
           due = next_multiple(every, due)) {
        if (!first && stop_wanted_ && stop_wanted_())
          left_out_ = due;
        else
          act(n, same_time(due, now) ? now : due);
        first = false;
      }
      if (last && acted_[n] < now) act(n, now);
    }
  }

  /// Time from which outputs of the last step are missing, s; empty: none is missing.
  [[nodiscard]] std::optional<double> left_out() const { return left_out_; }

 private:
  void act(std::size_t n, double t) {
    simulation_.show(t);
    observers_[n].act(t);
    acted_[n] = t;
  }

  Simulation& simulation_;
  const std::vector<Observer>& observers_;
  const std::function<bool()>& stop_wanted_;
  std::vector<double> acted_;
  std::optional<double> left_out_;
};

}  // namespace

void run(Simulation& simulation, const Stops& stops, const std::vector<Observer>& observers, bool at_start,
         const std::function<void(double)>& checkpoint, const std::function<bool()>& after_step,
         const std::function<bool()>& stop_wanted) {
  Outputs outputs(simulation, observers, stop_wanted);
  double before = simulation.time();
  if (at_start) outputs.at_start(before);
  Event event = next_event(stops, before);
  for (bool done = !is_later(stops.until, before); !done;) {
    simulation.step(event.time);
    const double now = simulation.time();
    const bool met = now >= event.time;
    done = met && !is_later(stops.until, now);
    outputs.of_step(before, now, done);
    before = now;
    const std::optional<double> left_out = outputs.left_out();
    const bool go_on = after_step() && !left_out;
    if (met || !go_on) {
      simulation.restart();
      if (event.checkpoint || done || !go_on) checkpoint(now);
      event = next_event(stops, now);
    }
    if (left_out)
      throw Stopped(fmt::format(
          "stopped by the user; a checkpoint of t = {:.9g} s has been written, without the outputs from {:.9g} s on",
          now, *left_out));
    if (!go_on && !done) throw Stopped("stopped by the user; a checkpoint has been written");
  }
}

}  // namespace polybed::core
