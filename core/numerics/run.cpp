#include "core/numerics/run.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/numerics/schedule.hpp"

namespace polybed::core {

namespace {

/// Where the next step must not go beyond.
struct Event {
  double time;      ///< s
  bool checkpoint;  ///< the run can be taken up again there
};

/// The next event after a time. Breakpoints and checkpoints that are the same event as another are met together, at the
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

}  // namespace

void run(Simulation& simulation, const Stops& stops, const std::vector<Observer>& observers, bool at_start,
         const std::function<void(double)>& checkpoint, const std::function<bool()>& after_step) {
  std::vector<double> acted(observers.size(), -std::numeric_limits<double>::infinity());
  const auto act = [&](std::size_t n, double t) {
    simulation.show(t);
    observers[n].act(t);
    acted[n] = t;
  };
  double before = simulation.time();
  for (std::size_t n = 0; n < observers.size() && at_start; ++n) act(n, before);
  Event event = next_event(stops, before);
  for (bool done = !is_later(stops.until, before); !done;) {
    simulation.step(event.time);
    const double now = simulation.time();
    const bool met = now >= event.time;
    done = met && !is_later(stops.until, now);
    for (std::size_t n = 0; n < observers.size(); ++n) {
      const double every = observers[n].every;
      for (double due = next_multiple(every, before); !is_later(due, now); due = next_multiple(every, due))
        act(n, same_time(due, now) ? now : due);
      if (done && acted[n] < now) act(n, now);
    }
    before = now;
    const bool go_on = after_step();
    if (met || !go_on) {
      simulation.restart();
      if (event.checkpoint || done || !go_on) checkpoint(now);
      event = next_event(stops, now);
    }
    if (!go_on && !done) throw Stopped("stopped by the user; a checkpoint has been written");
  }
}

}  // namespace polybed::core
