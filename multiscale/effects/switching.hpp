// Effects that are switched on in the course of a run, because the monitor has found them. What is on is built into a
// model when it is made: at a switch a run writes its checkpoint and goes on from it as a model with the effect, so
// that until then there is nothing of it.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::multiscale {

struct Switch {
  std::string effect;
  double time;  ///< from which on it is on, s
};

/// Whether an effect can be switched on in mid-run: lift and magnus, which keep nothing of the past and leave the step
/// of the particles as it is.
[[nodiscard]] bool can_be_switched(const std::string& effect);

/// The scene with what is on at a time, s.
[[nodiscard]] core::Scene at_time(core::Scene scene, const std::vector<Switch>& switches, double time);

/// The first switch after a time, s; infinity if there is none.
[[nodiscard]] double next_switch(const std::vector<Switch>& switches, double time);

/// Switches as the text of a checkpoint, and back.
[[nodiscard]] std::string text_of(const std::vector<Switch>& switches);
[[nodiscard]] std::vector<Switch> switches_of(const std::string& text);

}  // namespace polybed::multiscale
