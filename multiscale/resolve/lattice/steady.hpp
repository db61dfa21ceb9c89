// Flow through a box at a given superficial velocity, until its drag no longer changes.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "multiscale/resolve/lattice/flow.hpp"

namespace polybed::multiscale::lattice {

struct SteadyPlan {
  Point velocity{};         ///< superficial, cells per step
  double window = 100;      ///< steps in the average of forces; the memory time of the flow
  double tolerance = 1e-5;  ///< relative change of the drag from one window to the next
  std::int64_t most_steps = 200000;
};

struct SteadyFlow {
  Point velocity{};           ///< superficial, as measured at the end
  Point driving{};            ///< force on each fluid site: minus the gradient of the pressure
  std::vector<Point> forces;  ///< on each obstacle, mean of the last window
  double change = 0;          ///< of the drag in the last window, relative
  double imbalance = 0;       ///< between the forces on the obstacles and on the fluid, relative
  std::int64_t steps = 0;
};

/// State between two windows: with the flow, sufficient to continue a run.
struct SteadyProgress {
  std::int64_t steps = 0;
  double drag = 0, mean_drag = 0;  ///< over the last two steps; mean over the last window
  double change = 0;               ///< of mean_drag, relative
};

/// Returns false to stop.
using AfterWindow = std::function<bool(const SteadyProgress&)>;

/// Drives the flow with a force that keeps its mean velocity, and stops when `tolerance` is met, after `most_steps` or
/// at `after_window`'s request; `change` shows which. Throws core::NumericsError for populations that are not finite.
/// \param progress  where the run begins
template <class Real>
[[nodiscard]] SteadyFlow run_until_steady(Flow<Real>& flow, const SteadyPlan& plan,
                                          const AfterWindow& after_window = {}, SteadyProgress progress = {});

}  // namespace polybed::multiscale::lattice
