#include "multiscale/resolve/lattice/steady.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace polybed::multiscale::lattice {

namespace {

/// Steps in which the force corrects a deviation from the mean velocity: several times a sound wave's time across a few
/// cells, and short compared with the windows.
constexpr double response = 50;

double length_of(const Point& p) { return std::hypot(p[0], p[1], p[2]); }

}  // namespace

template <class Real>
SteadyFlow run_until_steady(Flow<Real>& flow, const SteadyPlan& plan, const AfterWindow& after_window,
                            SteadyProgress progress) {
  const std::array<int, 3>& box = flow.sites().box;
  const double sites = double(box[0]) * box[1] * box[2], fluid = flow.fluid_sites(), speed = length_of(plan.velocity);
  Point along = plan.velocity;
  for (double& component : along) component /= speed;
  const auto along_flow = [&](const Point& p) { return p[0] * along[0] + p[1] * along[1] + p[2] * along[2]; };
  const auto half_window = std::max<std::int64_t>(std::llround(plan.window / 2), 10);
  SteadyFlow result;
  double& drag = progress.drag;
  for (bool goes_on = true; goes_on;) {
    double momentum = along_flow(flow.velocity()) * sites, mean_push = 0, mean_drag = 0;
    flow.forget_forces();
    for (std::int64_t n = 0; n < half_window; ++n) {
      // The momentum of the fluid follows from the forces, measured only once per window.
      const double push = (drag + (speed * sites - momentum) / response) / fluid;
      flow.advance({push * along[0], push * along[1], push * along[2]});
      drag = along_flow(flow.force());
      momentum += 2 * (push * fluid - drag);
      mean_push += push / double(half_window);
      mean_drag += drag / double(half_window);
    }
    flow.level_density();
    progress.steps += 2 * half_window;
    if (!std::isfinite(mean_drag))
      throw core::NumericsError(fmt::format(
          "the resolved flow is no number any more after {} steps: finer cells, or a smaller Reynolds number",
          progress.steps));
    progress.change = std::abs(mean_drag - progress.mean_drag) / std::max(std::abs(mean_drag), 1e-300);
    progress.mean_drag = mean_drag;
    result.imbalance = std::abs(mean_drag / (mean_push * fluid) - 1);
    result.driving = {mean_push * along[0], mean_push * along[1], mean_push * along[2]};
    goes_on = progress.change > plan.tolerance && progress.steps < plan.most_steps;
    if (after_window && !after_window(progress)) goes_on = false;
  }
  result.steps = progress.steps;
  result.change = progress.change;
  result.velocity = flow.velocity();
  result.forces = flow.forces();
  return result;
}

template SteadyFlow run_until_steady<float>(Flow<float>&, const SteadyPlan&, const AfterWindow&, SteadyProgress);
template SteadyFlow run_until_steady<double>(Flow<double>&, const SteadyPlan&, const AfterWindow&, SteadyProgress);

}  // namespace polybed::multiscale::lattice
