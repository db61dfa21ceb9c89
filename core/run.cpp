#include "core/run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/error.hpp"

namespace polybed::core {

namespace {

/// Multiples of a period, counted in integers so that they do not drift.
class Periodic {
 public:
  Periodic(double every, double from) : every_(every) {
    if (every_ > 0) count_ = std::int64_t(std::floor(from / every_ * (1 + 1e-12))) + 1;
  }
  [[nodiscard]] double next() const {
    return every_ > 0 ? double(count_) * every_ : std::numeric_limits<double>::infinity();
  }
  void advance() { ++count_; }

 private:
  double every_;
  std::int64_t count_ = 0;
};

double next_kink(const std::vector<double>& kinks, double time) {
  double next = std::numeric_limits<double>::infinity();
  for (double kink : kinks)
    if (kink > time) next = std::min(next, kink);
  return next;
}

}  // namespace

void run(Simulation& simulation, const Stops& stops, const std::vector<Observer>& observers, bool at_start,
         const std::function<void(double)>& checkpoint, const std::function<bool()>& after_step) {
  std::vector<Periodic> due;
  for (const Observer& observer : observers) due.emplace_back(observer.every, simulation.time());
  Periodic checkpoint_due(stops.checkpoint_every, simulation.time());
  std::vector<double> acted(observers.size(), -std::numeric_limits<double>::infinity());
  const auto act = [&](std::size_t n, double t) {
    simulation.show(t);
    observers[n].act(t);
    acted[n] = t;
  };
  for (std::size_t n = 0; n < observers.size() && at_start; ++n) act(n, simulation.time());
  while (simulation.time() < stops.until) {
    const double kink = next_kink(stops.kinks, simulation.time());
    const double stop = std::min({stops.until, checkpoint_due.next(), kink});
    simulation.step(stop);
    const double now = simulation.time();
    const bool last = now >= stops.until;
    for (std::size_t n = 0; n < observers.size(); ++n) {
      for (; due[n].next() <= now; due[n].advance()) act(n, due[n].next());
      if (last && acted[n] < now) act(n, now);
    }
    const bool go_on = after_step();
    if (now >= stop || !go_on) {
      simulation.restart();
      if (last || !go_on || now >= checkpoint_due.next()) checkpoint(now);
      if (now >= checkpoint_due.next()) checkpoint_due.advance();
    }
    if (!go_on && !last) throw Stopped("stopped by the user; a checkpoint has been written");
  }
}

}  // namespace polybed::core
