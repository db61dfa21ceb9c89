// A box of spheres that travel, run over its time.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "multiscale/resolve/box_drag.hpp"

namespace polybed::multiscale {

/// Steps of the fluid between two samples of velocities, which change more slowly.
inline constexpr std::int64_t sampled = 20;

/// Throws as box_drag(). \param Box  FreeBox or MovingBox
template <class Box>
BoxDrag run_timed(Box& box, const core::Scene& scene, const StillWanted& wanted, const KeptBox* kept) {
  std::int64_t done = 0;
  double before = 0;  // s on the clock, in earlier runs
  if (const auto state = kept != nullptr ? kept->read() : std::nullopt) {
    core::name_checkpoint(kept->path, [&] {
      box.restore(*state);
      kept->restore(box.flow(), *state);
      done = state->count("box_steps");
      before = state->time("seconds");
    });
  }
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return before + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  double last_kept = before;
  const std::int64_t steps = box.plan().steps, window = 2 * std::llround(box.plan().window / 2);
  for (std::int64_t next = done + window; done < steps; next += window) {
    for (; done < std::min(next, steps); done += 2) {
      if (done == box.plan().dropped) box.forget();
      box.step();
      if (done % sampled == 0) box.sample();
    }
    box.begin_window();
    const bool stopped = !wanted(double(done), 0);
    if (kept != nullptr && (stopped || seconds() - last_kept > kept->every)) {
      last_kept = seconds();
      core::Checkpoint state = box.state();
      state.integers["box_steps"] = done;
      state.numbers["seconds"] = last_kept;
      kept->write(box.flow(), std::move(state));
    }
    if (stopped) throw core::Stopped("stopped by the user");
  }
  if (kept != nullptr) kept->remove();
  BoxDrag drag = box.means();
  drag.seconds = seconds();
  drag.steps = double(steps);
  drag.sites = std::pow(box.plan().edge, 3);
  drag.cells = least_diameter(scene) * box.plan().scale;
  return drag;
}

/// The same for a new box, at the precision of the case.
template <template <class> class Box>
BoxDrag run_box(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing,
                const StillWanted& wanted, const KeptBox* kept) {
  const auto run = [&]<class Real>(Real) {
    Box<Real> box(scene, point, packing);
    return run_timed(box, scene, wanted, kept);
  };
  return scene.resolve.precision == core::Precision::one ? run(float()) : run(double());
}

}  // namespace polybed::multiscale
